// Share of a light's colour that arrives over a distance: 1 / (a + b d + c d^2).
#ifndef RELIEVO_SHADING_ATTENUATION
#define RELIEVO_SHADING_ATTENUATION

float attenuation(float constant, float linear, float quadratic, float distance_to_light) {
    return 1.0f / (constant + distance_to_light * (linear + distance_to_light * quadratic));
}

#endif
