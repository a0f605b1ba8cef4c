// Emboss bump mapping (Peeples, Michael 1999): the diffuse light from two heights, without a normal. Where the ground a little toward
// the light is lower, the slope faces the light and is brighter.
//   L = l_z + (h(uv) - h(uv + e l_xy)) height_scale / e
// is Lambert's n.l times |n| to first order in the slope, so gentle relief is right; there is no normal, hence no highlight. Then it
// was two passes of a texture unit, with the gain height_scale / e painted into the map.
#ifndef RELIEVO_SHADING_EMBOSS
#define RELIEVO_SHADING_EMBOSS

#include "../surface/height_slopes.glsl"

// In [0,1], as a frame buffer kept it. to_light is unit, tangent space. Two fetches.
float emboss_diffuse(vec2 uv, float lod, float height_scale, vec3 to_light) {
    vec2 reach = slope_reach(lod);
    float e = max(reach.x, reach.y);
    float lower = height_at(uv) - height_at(uv + e * vec2(to_light.x, to_light.y));
    return clamp(to_light.z + lower * (height_scale / e), 0.0f, 1.0f);
}

#endif
