// The colour alone: the pass that is timed.
#include "surface.glsl"

layout(location = 0) out vec4 colour;

void main() {
    SurfaceRay ray = view_ray(base_uv, pixel_view(), relief.height_scale, relief.zero_level, pixel_lod());
    SurfaceHit hit = technique(ray, march);
    vec3 background = vec3(scene.background_r, scene.background_g, scene.background_b);
    colour = vec4(hit.found ? surface_colour(ray, hit) : background, 1.0f);
}
