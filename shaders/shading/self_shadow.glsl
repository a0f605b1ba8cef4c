// Hard self-shadow: the technique that found the hit is asked the same question from the light. No technique has a shadow
// function of its own; a technique that misses thin features misses their shadows too, which is what is to be shown.
#ifndef RELIEVO_SHADING_SELF_SHADOW
#define RELIEVO_SHADING_SELF_SHADOW

#include "../surface/ray_entry.glsl"

// The light ray ends this much above the hit (a share of the relief's amplitude), or the surface would shadow itself: a hit lies
// up to a bisection's last interval, 1 / (30 * 2^6) = 0.0005, below the field. Four times that also clears the tolerance of
// 0.001 at which cone stepping stops. What it costs: the first 0.002 of a shadow's foot is lit.
const float shadow_bias = 0.002f;

// 1 where the key light arrives, 0 where the relief is in its way. to_light is unit, tangent space.
float self_shadow(SurfaceRay ray, SurfaceHit hit, vec3 to_light, MarchParams params) {
    float visible = 1.0f;
    if (to_light.z <= 0.0f) {
        visible = 0.0f;  // below the plane's horizon
    } else if (hit.height + shadow_bias < 1.0f) {  // else nothing rises above the hit
        if (technique(light_ray(ray, hit, to_light, shadow_bias), params).found) visible = 0.0f;
    }
    return visible;
}

#endif
