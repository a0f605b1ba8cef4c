// The only doors to the maps. Each call is one texture fetch and is counted as one; a host (or the C++ shim) implements them.
#ifndef RELIEVO_SURFACE_MAPS
#define RELIEVO_SURFACE_MAPS
#ifndef __cplusplus  // C++ finds these in techniques/glsl.h

ivec2 height_size();                    // texels of the height map; no fetch
float height_at(vec2 uv);               // bilinear height, always of the finest level: the declared surface
vec4 height_cell(vec2 middle);          // corner heights h00, h10, h01, h11 of the bilinear cell round a UV, its middle or near that
vec3 normal_at(vec2 uv, float lod);     // unit normal, tangent space, +Y along +v; lod as in SurfaceRay
vec2 cone_at(vec2 uv);                  // height and cone ratio together, bilinear
vec2 conservative_cone_at(vec2 uv);     // the same of the conservative cones
vec2 relaxed_cone_at(vec2 uv);          // the same of the relaxed cones
vec2 conservative_cone(ivec2 texel);    // of one texel, any integers: a cone is safe at its own apex, blended ones need not be
vec2 relaxed_cone(ivec2 texel);
vec2 robust_cone(ivec2 texel);          // height of the texel, and a ratio for any point of its square
float horizon_at(vec2 uv, int direction);  // code of the horizon's elevation, bilinear; direction as in shading/horizon_shadow
float distance_at(vec3 uvz);            // distance to the relief in heights, trilinear, rounded down; z in [0,1] (maps/distance_map.h)
int max_levels();                       // levels of the pyramid of maxima; no fetch
float max_at(ivec2 node, int level);    // largest corner height in a node; node inside one period
vec4 cell_cone(vec2 corner, int quadrant);  // of the cell whose first corner is the texel at a UV: largest corner, near, middle and far roof; quadrant in [0,4) (maps/cell_cone.h)

#endif

// Directions of the horizon map.
const int horizon_directions = 32;

// How far the roofs of a cell cone reach, in cells ahead along both axes.
const int near_roof_reach = 2;
const int middle_roof_reach = 8;
const int far_roof_reach = 32;

#endif
