// The slopes of the height map, by differences.
#ifndef RELIEVO_SURFACE_HEIGHT_SLOPES
#define RELIEVO_SURFACE_HEIGHT_SLOPES

#include "maps.glsl"

// How far apart heights are compared, UV units along u and v: one texel, which at texel centres gives the slopes the normal map was
// made from; half the pixel where that is wider, so that the mean slope across the pixel is taken and not a random one in it.
vec2 slope_reach(float lod) {
    ivec2 size = height_size();
    float half_pixel = 0.5f * exp2(lod);
    return vec2(max(1.0f / float(size.x), half_pixel), max(1.0f / float(size.y), half_pixel));
}

// dh/du and dh/dv by central differences; lod as in SurfaceRay. Four fetches.
vec2 height_slopes(vec2 uv, float lod) {
    vec2 reach = slope_reach(lod);
    vec2 along_u = vec2(reach.x, 0.0f);
    vec2 along_v = vec2(0.0f, reach.y);
    return vec2((height_at(uv + along_u) - height_at(uv - along_u)) / (2.0f * reach.x),
                (height_at(uv + along_v) - height_at(uv - along_v)) / (2.0f * reach.y));
}

#endif
