// Soft shadow by brute force: the technique is asked from many points of the light. Points lie on a sunflower's spiral (Vogel 1979),
// which spreads any number of them evenly over a disc.
#ifndef RELIEVO_SHADING_AREA_SHADOW
#define RELIEVO_SHADING_AREA_SHADOW

#include "light_disc.glsl"
#include "self_shadow.glsl"

float area_shadow(SurfaceRay ray, SurfaceHit hit, vec3 to_light, float bias, MarchParams params, float chart, float radius,
                  int samples) {
    float visible = 0.0f;
    for (int i = 0; i < samples; ++i) {
        float r = sqrt((float(i) + 0.5f) / float(samples));
        float turn = 2.3999632f * float(i);  // the golden angle
        vec3 direction = disc_direction(to_light, radius, vec2(cos(turn), sin(turn)) * r);
        visible += self_shadow(ray, hit, direction, bias, params, chart);
    }
    return visible / float(samples);
}

#endif
