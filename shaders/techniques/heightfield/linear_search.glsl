// Linear search, also steep parallax mapping (McGuire & McGuire 2005): equal steps down the ray until one ends below the field.
// The first sample is where the ray enters, as in the paper's loop, so that what stands at the top is seen there. One fetch a
// step. Features thinner than a step are stepped over, and every hit is late by up to a step, which shows as slices.
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit linear_search(SurfaceRay ray, MarchParams params) {
    SurfaceHit hit;
    hit.found = false;
    hit.height = ray.z_end;
    for (int i = 0; i < params.max_steps && !hit.found; ++i) {
        float z = mix(ray.z_start, ray.z_end, float(i) / float(params.max_steps));
        if (height_at(uv_at(ray, z)) >= z) {
            hit.found = true;
            hit.height = z;
        }
    }
    // The last step ends at z_end. A view ray needs no fetch there: every field is at least 0. A shadow ray ends at the point
    // that asks, which does not shadow itself.
    if (!hit.found && ray.z_end <= 0.0f) hit.found = true;
    hit.uv = uv_at(ray, hit.height);
    return hit;
}
