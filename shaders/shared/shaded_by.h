// What the light falls on where a technique has found its hit: the column `shaded_by` of the catalogue, the specialization constant
// of hosts/heightfield/surface.glsl.
#ifndef RELIEVO_SHARED_SHADED_BY_H
#define RELIEVO_SHARED_SHADED_BY_H

const int shaded_by_polygon = 0;        // the polygon's own normal
const int shaded_by_normal_map = 1;
const int shaded_by_height_slopes = 2;  // a normal tilted by differences of heights (shading/bump_normal.glsl)
const int shaded_by_emboss = 3;         // no normal: a diffuse factor from two heights (shading/emboss.glsl)

#endif
