// Soft shadow from a horizon map (Max 1988, Horizon Mapping: Shadows for Bump-Mapped Surfaces): the map knows under which elevation
// the sky begins in each of 32 directions of the plane; the share of the light's disc above it is what arrives. Two fetches of the
// map, and six heights.
//
// The map errs in two ways. Between two of its directions the horizon is taken to change linearly, which blurs the shadow of what is
// narrower than they are apart. And between its texels: on a wall most points lie between one texel at its top and one at its foot,
// whose horizons have nothing in common. What is that near is therefore asked of the heights themselves.
#ifndef RELIEVO_SHADING_HORIZON_SHADOW
#define RELIEVO_SHADING_HORIZON_SHADOW

#include "../surface/chart.glsl"
#include "../surface/maps.glsl"
#include "light_disc.glsl"

// Where an azimuth stands among the map's directions, in [0, horizon_directions); `toward` in texels. The directions are the steps
// (4,0), (4,1) ... (4,4), (3,4) ... (0,4) ... of the grid of texels, evenly spaced not in angle but on the square round the texel
// (maps/horizon_map.h).
float horizon_direction(vec2 toward) {
    const float quarter = float(horizon_directions / 4);
    vec2 d = toward;
    float first = 0.0f;
    if (toward.x <= 0.0f && toward.y > 0.0f) {
        d = vec2(toward.y, -toward.x);
        first = quarter;
    } else if (toward.x < 0.0f && toward.y <= 0.0f) {
        d = vec2(-toward.x, -toward.y);
        first = 2.0f * quarter;
    } else if (toward.x >= 0.0f && toward.y < 0.0f) {
        d = vec2(-toward.y, toward.x);
        first = 3.0f * quarter;
    }
    float within = d.y <= d.x ? 0.5f * quarter * d.y / max(d.x, 1e-12f) : quarter - 0.5f * quarter * d.x / d.y;
    return first + within;
}

// The horizon in the direction of a light, as a slope in heights per unit of UV. toward_texels: that direction in texels.
float mapped_horizon(vec2 uv, vec2 toward_texels) {
    float direction = horizon_direction(toward_texels);
    float first = floor(direction);
    int a = int(first) % horizon_directions;
    float code = mix(horizon_at(uv, a), horizon_at(uv, (a + 1) % horizon_directions), direction - first);
    // Stored as the angle that a relief of a tenth of a repeat would have, so that one map serves every height_scale.
    return tan(min(code, 0.9999f) * 1.5707963f) * 10.0f;
}

// Rise from height z at uv to the surface at a distance in UV, as a slope; 0 beyond the chart.
float rise_to(vec2 uv, float z, vec2 toward, float way, float chart) {
    vec2 there = uv + toward * way;
    return on_chart(there, chart) ? (height_at(there) - z) / way : 0.0f;
}

// The steepest of five slopes within four texels. They stand the denser the nearer, as an angle needs them.
float near_horizon(vec2 uv, float z, vec2 toward, float texel, float chart) {
    float steepest = rise_to(uv, z, toward, 0.4f * texel, chart);
    steepest = max(steepest, rise_to(uv, z, toward, 0.9f * texel, chart));
    steepest = max(steepest, rise_to(uv, z, toward, 1.5f * texel, chart));
    steepest = max(steepest, rise_to(uv, z, toward, 2.4f * texel, chart));
    return max(steepest, rise_to(uv, z, toward, 3.8f * texel, chart));
}

// The map knows of no border. What it saw stands no farther away than the top of the slab is met at its slope; where the relief ends
// nearer than that, heights up to the border may only lower what it said.
float horizon_before_border(vec2 uv, float z, vec2 toward, float chart, float mapped) {
    vec2 to_border = vec2(toward.x > 1e-6f ? (chart - uv.x) / toward.x : (toward.x < -1e-6f ? -uv.x / toward.x : 1e9f),
                          toward.y > 1e-6f ? (chart - uv.y) / toward.y : (toward.y < -1e-6f ? -uv.y / toward.y : 1e9f));
    float border = max(min(to_border.x, to_border.y), 0.0f);
    float horizon = mapped;
    if ((1.0f - z) > mapped * border) {
        const int samples = 16;
        float steepest = 0.0f;
        for (int i = 0; i < samples; ++i) {
            float way = max(border * (float(i) + 0.5f) / float(samples), 1e-6f);
            steepest = max(steepest, (height_at(uv + toward * way) - z) / way);
        }
        horizon = min(mapped, steepest);
    }
    return horizon;
}

// chart: as in surface/chart.glsl.
float horizon_shadow(SurfaceRay ray, SurfaceHit hit, vec3 to_light, float radius, float chart) {
    float visible = 0.0f;
    if (to_light.z > 0.0f) {
        ivec2 size = height_size();
        vec2 flat_light = vec2(to_light);
        vec2 toward = flat_light / max(length(flat_light), 1e-6f);
        vec2 toward_texels = vec2(toward.x * float(size.x), toward.y * float(size.y));
        float texel = 1.0f / max(max(abs(toward_texels.x), abs(toward_texels.y)), 1e-6f);
        float z = height_at(hit.uv);  // and not the hit's: a search that ends below the surface would shadow itself
        float slope = mapped_horizon(hit.uv, toward_texels);
        if (chart > 0.0f) slope = horizon_before_border(hit.uv, z, toward, chart, slope);
        slope = max(slope, near_horizon(hit.uv, z, toward, texel, chart));
        float elevation = asin(clamp(to_light.z, -1.0f, 1.0f));
        visible = disc_above((elevation - atan(slope * ray.height_scale)) / max(radius, 1e-4f));
    }
    return visible;
}

#endif
