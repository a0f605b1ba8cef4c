// Soft shadow by the deepest penetration: how far the light ray dips below the field tells how much of the light is hidden,
// 1 - d / M (Mile 2008, 3.6.6, after Tatarchuk 2006). The ray is followed past the first blocker, all the way. The light's size and
// the blocker's distance do not enter, so that penumbrae are as wide at a wall's foot as at the shadow's end.
#ifndef RELIEVO_SHADING_PENETRATION_SHADOW
#define RELIEVO_SHADING_PENETRATION_SHADOW

#include "../surface/maps.glsl"
#include "../surface/ray_entry.glsl"

float penetration_shadow(SurfaceRay light, float depth, int samples) {
    float deepest = 0.0f;
    float way = light.z_start - light.z_end;
    for (int i = 0; i < samples; ++i) {
        float z = light.z_end + way * (float(i) + 0.5f) / float(samples);
        deepest = max(deepest, height_at(uv_at(light, z)) - z);
    }
    return clamp(1.0f - deepest / depth, 0.0f, 1.0f);
}

#endif
