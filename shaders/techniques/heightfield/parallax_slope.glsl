// Parallax mapping taking account of the slope (Premecz 2006): the offset-limited shift weighted by n_z, so that steep flanks,
// where the flat-surface guess is worst, move less. Two fetches.
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit parallax_slope(SurfaceRay ray, MarchParams params) {
    SurfaceHit hit;
    float slope = normal_at(ray.uv, ray.lod).z;
    hit.height = height_at(ray.uv);
    hit.uv = ray.uv + slope * (hit.height - ray.zero_level) * ray.height_scale * vec2(ray.view.x, ray.view.y);
    hit.found = true;
    return hit;
}
