// Share of the key light that arrives at a hit, by the way that was chosen (techniques/modifiers.h). The modes are constants of the
// program, so that only one way is left in it.
#ifndef RELIEVO_SHADING_KEY_SHADOW
#define RELIEVO_SHADING_KEY_SHADOW

#include "../surface/modified_ray.glsl"
#include "area_shadow.glsl"
#include "horizon_shadow.glsl"
#include "penetration_shadow.glsl"
#include "self_shadow.glsl"
#include "weighted_shadow.glsl"

// The gap under a light ray's end for this pixel's hit: `bias` is that of a search with all its steps, and with fewer of them a hit lies
// deeper below the field by as much. 0 stays 0: exact searches have no number of steps to err by.
float bias_of_hit(SurfaceRay ray, float bias, MarchParams params, DrawModes modes, DrawNumbers numbers) {
    float clear = bias;
    if (modes.steps != steps_fixed) clear *= float(params.max_steps) / float(modified_march(params, ray, modes, numbers).max_steps);
    return clear;
}

// to_light: toward the light's middle, unit, tangent space. params: the search's, with what angles change about it left out, as the light
// ray has an angle of its own.
float key_shadow(SurfaceRay ray, SurfaceHit hit, vec3 to_light, float bias, MarchParams params, DrawModes modes, DrawNumbers numbers) {
    float visible = 1.0f;
    int mode = modes.shadow;
    float chart = modes.border == border_repeat ? 0.0f : numbers.chart;
    if (mode == shadow_hard) {
        visible = self_shadow(ray, hit, to_light, bias_of_hit(ray, bias, params, modes, numbers), params, chart);
    } else if (mode == shadow_area) {
        visible = area_shadow(ray, hit, to_light, bias_of_hit(ray, bias, params, modes, numbers), params, chart, numbers.light_radius, numbers.shadow_samples);
    } else if (mode == shadow_horizon) {
        visible = horizon_shadow(ray, hit, to_light, numbers.light_radius, chart);
    } else if (mode != shadow_none && to_light.z <= 0.0f) {
        visible = 0.0f;
    } else if (mode == shadow_soft) {
        visible = penetration_shadow(over_chart(light_ray(ray, hit, to_light, 0.0f), chart), numbers.shadow_depth, numbers.shadow_samples);
    } else if (mode == shadow_tatarchuk) {
        visible = weighted_shadow(light_ray(ray, hit, to_light, 0.0f), hit, numbers.shadow_softening, chart);
    }
    return visible;
}

#endif
