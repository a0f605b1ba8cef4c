// Iterative parallax mapping (Premecz 2006): move along the ray by the gap between the field and the ray's own height, weighted
// by n_z; near a smooth surface this is a damped Newton step and converges. Two fetches an iteration.
// The ray's height is tracked (the gap is h - z, not h): without it the estimate drifts by h at every repetition.
// No first hit is promised: behind a steep wall it settles on whichever crossing is near.
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit parallax_iterative(SurfaceRay ray, MarchParams params) {
    float z = ray.zero_level;
    for (int i = 0; i < params.iterations; ++i) {
        vec2 uv = uv_at(ray, z);
        // The unit view vector advances by n_z * gap * height_scale, which raises the ray by that times view.z / height_scale.
        z += normal_at(uv, ray.lod).z * (height_at(uv) - z) * ray.view.z;
    }
    SurfaceHit hit;
    hit.height = clamp(z, 0.0f, 1.0f);
    hit.uv = uv_at(ray, hit.height);
    hit.found = true;
    return hit;
}
