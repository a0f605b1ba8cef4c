// Averaged parallax: the offset-limited shift, repeated with the mean of the height it was made from and the height it led to.
//   H <- (H + h(uv + shift(H))) / 2,  iterations times
// Half a step of the plain repetition, which would jump to and fro where the slope is steep. iterations + 1 fetches. As the shift is
// not divided by the view's cosine, it settles where a steeper ray meets the field; behind a sharp edge, wherever that is.
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit parallax_averaged(SurfaceRay ray, MarchParams params) {
    vec2 shift = ray.height_scale * vec2(ray.view.x, ray.view.y);
    SurfaceHit hit;
    hit.height = height_at(ray.uv);
    for (int i = 0; i < params.iterations; ++i)
        hit.height = 0.5f * (hit.height + height_at(ray.uv + (hit.height - ray.zero_level) * shift));
    hit.uv = ray.uv + (hit.height - ray.zero_level) * shift;
    hit.found = true;
    return hit;
}
