// The facts under each pixel (core/frame.h): everything a Frame holds but colour. coverage: 1 hit, 2 no hit.
#include "surface.glsl"

layout(location = 0) out vec4 uv_height_coverage;
layout(location = 1) out vec4 normal_shadow;
layout(location = 2) out float fetches;

void main() {
    SurfaceRay ray = view_ray(base_uv, pixel_view(), relief.height_scale, relief.zero_level, pixel_lod());
    SurfaceHit hit = technique(ray, march);
    fetches = float(fetch_count);  // before shading adds its own
    uv_height_coverage = vec4(0.0f, 0.0f, 0.0f, 2.0f);
    normal_shadow = vec4(0.0f);
    if (hit.found) {
        uv_height_coverage = vec4(hit.uv, hit.height, 1.0f);
        normal_shadow = vec4(surface_normal(ray, hit), key_visibility(ray, hit));
    }
}
