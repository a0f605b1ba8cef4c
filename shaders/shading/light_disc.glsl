// A light of some size, as seen from the surface: the disc of directions at elevation e + radius y and azimuth a + radius x / cos e,
// x^2 + y^2 <= 1, about the direction toward its middle. reference/area_light.h has the same disc in double.
#ifndef RELIEVO_SHADING_LIGHT_DISC
#define RELIEVO_SHADING_LIGHT_DISC

// Direction of a point of the disc; unit, tangent space.
vec3 disc_direction(vec3 to_light, float radius, vec2 point) {
    float flat_length = max(length(vec2(to_light)), 1e-6f);
    float elevation = asin(clamp(to_light.z, -1.0f, 1.0f)) + radius * point.y;
    float turn = radius * point.x / flat_length;
    vec2 ahead = vec2(to_light) / flat_length;
    vec2 aside = vec2(-ahead.y, ahead.x);
    vec2 azimuth = ahead * cos(turn) + aside * sin(turn);
    return vec3(azimuth * cos(elevation), sin(elevation));
}

// Share of a disc that stands above a straight horizon; `above` is how far its middle does, in radii.
float disc_above(float above) {
    float x = clamp(above, -1.0f, 1.0f);
    return clamp(0.5f + (x * sqrt(1.0f - x * x) + asin(x)) * 0.31830989f, 0.0f, 1.0f);
}

#endif
