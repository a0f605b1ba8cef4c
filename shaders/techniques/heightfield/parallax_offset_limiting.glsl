// Parallax mapping with offset limiting (Welsh 2004): the shift without its division by the view's cosine, so that it never
// exceeds the relief's amplitude. Calm at grazing angles, where the relief flattens instead.
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit parallax_offset_limiting(SurfaceRay ray, MarchParams params) {
    SurfaceHit hit;
    hit.height = height_at(ray.uv);
    hit.uv = ray.uv + (hit.height - ray.zero_level) * ray.height_scale * vec2(ray.view.x, ray.view.y);
    hit.found = true;
    return hit;
}
