// The normal that the light falls on, by the technique's shaded_by (shared/shaded_by.h).
#ifndef RELIEVO_SHADING_SHADING_NORMAL
#define RELIEVO_SHADING_SHADING_NORMAL

#include "../shared/shaded_by.h"
#include "../surface/maps.glsl"
#include "bump_normal.glsl"

// Unit, tangent space; the polygon's own where no normal is used. lod as in SurfaceRay, height_scale in UV units.
vec3 shading_normal(int shaded_by, vec2 uv, float lod, float height_scale) {
    vec3 normal = vec3(0.0f, 0.0f, 1.0f);
    if (shaded_by == shaded_by_normal_map) {
        normal = normal_at(uv, lod);
    } else if (shaded_by == shaded_by_height_slopes) {
        normal = bump_normal(vec3(1.0f, 0.0f, 0.0f), vec3(0.0f, 1.0f, 0.0f), height_slopes(uv, lod) * height_scale);
    }
    return normal;
}

#endif
