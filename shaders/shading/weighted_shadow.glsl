// Approximate soft shadow from eight samples (Tatarchuk 2006, Dynamic Parallax Occlusion Mapping with Approximate Soft Shadows):
// the height at the hit and seven along the light ray; each excess over the ray counts the more the nearer it is. Her final
// brightening, which keeps 40 % of the light in every shadow, is left out: it is a matter of taste and not of light.
#ifndef RELIEVO_SHADING_WEIGHTED_SHADOW
#define RELIEVO_SHADING_WEIGHTED_SHADOW

#include "../surface/chart.glsl"
#include "../surface/maps.glsl"
#include "../surface/ray_entry.glsl"

float weighted_excess(SurfaceRay light, float from, float up, float weight, float chart) {
    vec2 there = uv_at(light, from + up);
    return on_chart(there, chart) ? (height_at(there) - from - up) * weight : 0.0f;
}

float weighted_shadow(SurfaceRay light, SurfaceHit hit, float softening, float chart) {
    float from = height_at(hit.uv);
    float most = weighted_excess(light, from, 0.88f, 1.0f, chart);
    most = max(most, weighted_excess(light, from, 0.77f, 2.0f, chart));
    most = max(most, weighted_excess(light, from, 0.66f, 4.0f, chart));
    most = max(most, weighted_excess(light, from, 0.55f, 6.0f, chart));
    most = max(most, weighted_excess(light, from, 0.44f, 8.0f, chart));
    most = max(most, weighted_excess(light, from, 0.33f, 10.0f, chart));
    most = max(most, weighted_excess(light, from, 0.22f, 12.0f, chart));
    return clamp(1.0f - most * softening, 0.0f, 1.0f);
}

#endif
