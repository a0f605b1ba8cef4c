// Soft shadow from a horizon map (Max 1988, Horizon Mapping: Shadows for Bump-Mapped Surfaces): the map knows under which elevation
// the sky begins in each of 16 directions of the plane; the share of the light's disc above it is what arrives. Two fetches. Between
// two of the directions the horizon is taken to change linearly, which blurs the shadow of what is narrower than they are apart.
#ifndef RELIEVO_SHADING_HORIZON_SHADOW
#define RELIEVO_SHADING_HORIZON_SHADOW

#include "../surface/maps.glsl"
#include "light_disc.glsl"

// Where an azimuth stands among the map's directions, in [0,16); `toward` in texels. The directions are the steps (2,0), (2,1),
// (2,2), (1,2), (0,2) ... of the grid of texels, evenly spaced not in angle but on the square round the texel (maps/horizon_map.h).
float horizon_direction(vec2 toward) {
    vec2 d = toward;
    float quadrant = 0.0f;
    if (toward.x <= 0.0f && toward.y > 0.0f) {
        d = vec2(toward.y, -toward.x);
        quadrant = 4.0f;
    } else if (toward.x < 0.0f && toward.y <= 0.0f) {
        d = vec2(-toward.x, -toward.y);
        quadrant = 8.0f;
    } else if (toward.x >= 0.0f && toward.y < 0.0f) {
        d = vec2(-toward.y, toward.x);
        quadrant = 12.0f;
    }
    float within = d.y <= d.x ? 2.0f * d.y / max(d.x, 1e-12f) : 4.0f - 2.0f * d.x / d.y;
    return quadrant + within;
}

// Elevation of the horizon, radians, in the direction of a light.
float horizon_elevation(vec2 uv, vec2 to_light, float height_scale) {
    ivec2 size = height_size();
    float direction = horizon_direction(vec2(to_light.x * float(size.x), to_light.y * float(size.y)));
    float first = floor(direction);
    int a = int(first) % 16;
    float code = mix(horizon_at(uv, a), horizon_at(uv, (a + 1) % 16), direction - first);
    // Stored as the angle that a relief of a tenth of a repeat would have, so that one map serves every height_scale.
    return atan(tan(min(code, 0.9999f) * 1.5707963f) * (10.0f * height_scale));
}

float horizon_shadow(SurfaceRay ray, SurfaceHit hit, vec3 to_light, float radius) {
    float elevation = asin(clamp(to_light.z, -1.0f, 1.0f));
    float horizon = horizon_elevation(hit.uv, vec2(to_light), ray.height_scale);
    return disc_above((elevation - horizon) / max(radius, 1e-4f));
}

#endif
