// A relief that ends: beyond the square [0, chart]^2 of UV there is nothing, so a ray is searched only where it stands over it. What
// leaves the square unmet shows what is behind, and the relief has a silhouette. chart = 0: the texture repeats without end.
#ifndef RELIEVO_SURFACE_CHART
#define RELIEVO_SURFACE_CHART

#include "ray_entry.glsl"

// Heights at which a ray stands over [0, chart] along one axis, as (lowest, highest); lowest above highest where it never does.
vec2 heights_over(float uv, float uv_per_height, float zero_level, float chart) {
    vec2 range = uv >= 0.0f && uv <= chart ? vec2(-1.0e9f, 1.0e9f) : vec2(1.0e9f, -1.0e9f);
    if (abs(uv_per_height) > 1.0e-9f) {
        float a = zero_level - uv / uv_per_height;
        float b = zero_level + (chart - uv) / uv_per_height;
        range = vec2(min(a, b), max(a, b));
    }
    return range;
}

SurfaceRay over_chart(SurfaceRay ray, float chart) {
    SurfaceRay r = ray;
    if (chart > 0.0f) {
        vec2 u = heights_over(ray.uv.x, ray.uv_per_height.x, ray.zero_level, chart);
        vec2 v = heights_over(ray.uv.y, ray.uv_per_height.y, ray.zero_level, chart);
        r.z_start = min(ray.z_start, min(u.y, v.y));
        r.z_end = max(ray.z_end, max(u.x, v.x));
    }
    return r;
}

// Whether a hit lies on the chart: techniques that shift once may land beyond it.
bool on_chart(vec2 uv, float chart) {
    const float rim = 1e-5f;  // what float leaves of a ray that ends on the border
    return chart <= 0.0f || (uv.x >= -rim && uv.y >= -rim && uv.x <= chart + rim && uv.y <= chart + rim);
}

#endif
