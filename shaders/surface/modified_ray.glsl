// The ray and the settings that a pixel's search gets, with what the modifiers change about them (techniques/modifiers.h).
#ifndef RELIEVO_SURFACE_MODIFIED_RAY
#define RELIEVO_SURFACE_MODIFIED_RAY

#include "by_angle.glsl"
#include "chart.glsl"
#include "maps.glsl"
#include "ray_entry.glsl"

SurfaceRay modified_ray(SurfaceRay entering, DrawModes modes, DrawNumbers numbers) {
    float share = scale_by_angle(entering.view.z, modes.scale, numbers.least_scale, numbers.scale_exponent);
    if (modes.fade == fade_footprint) {
        ivec2 size = height_size();
        share *= scale_by_footprint(exp2(entering.lod) * float(max(size.x, size.y)), numbers.fade_near, numbers.fade_far);
    }
    SurfaceRay ray = entering;
    ray.height_scale = entering.height_scale * share;
    ray.uv_per_height = entering.uv_per_height * share;
    if (modes.border != border_repeat) ray = over_chart(ray, numbers.chart);
    return ray;
}

MarchParams modified_march(MarchParams march, SurfaceRay ray, DrawModes modes, DrawNumbers numbers) {
    MarchParams params = march;
    if (modes.steps != steps_fixed) {
        ivec2 size = height_size();
        float texels = length(vec2(ray.uv_per_height.x * float(size.x), ray.uv_per_height.y * float(size.y)));
        params.max_steps = steps_by_angle(march.max_steps, ray.view.z, texels, modes.steps, numbers.least_steps);
        params.min_steps = min(march.min_steps, params.max_steps);
    }
    return params;
}

// The technique's answer, where there is something to search.
SurfaceHit modified_search(SurfaceRay ray, MarchParams params, DrawModes modes, DrawNumbers numbers) {
    SurfaceHit hit;
    hit.uv = ray.uv;
    hit.height = ray.z_end;
    hit.found = false;
    if (modes.border == border_repeat || ray.z_start > ray.z_end) hit = technique(ray, params);
    if (modes.border != border_repeat && !on_chart(hit.uv, numbers.chart)) hit.found = false;
    return hit;
}

#endif
