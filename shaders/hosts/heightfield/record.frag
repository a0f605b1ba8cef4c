// The facts under each pixel (core/frame.h): everything a Frame holds but colour. coverage: 1 hit, 2 no hit.
#include "surface.glsl"

layout(location = 0) out vec4 uv_height_coverage;
layout(location = 1) out vec4 normal_shadow;
layout(location = 2) out float fetches;

void main() {
    SurfaceRay ray = pixel_ray();
    SurfaceHit hit = modified_search(ray, modified_march(march, ray, draw_modes(), numbers), draw_modes(), numbers);
    fetches = float(fetch_count);  // before shading adds its own
    uv_height_coverage = vec4(0.0f, 0.0f, 0.0f, 2.0f);
    normal_shadow = vec4(0.0f);
    if (hit.found) {
        uv_height_coverage = vec4(hit.uv, hit.height, 1.0f);
        normal_shadow = vec4(surface_normal(shading_ray(ray, hit), hit), key_visibility(ray, hit));
    }
}
