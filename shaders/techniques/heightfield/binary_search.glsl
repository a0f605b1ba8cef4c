// Bisection of the whole ray (the second half of Policarpo, Oliveira, Comba 2005, alone): halve the interval between above and
// below the field. One fetch a step and sub-texel precision, but of *a* crossing: where the ray crosses the field more than
// once it often returns a hidden one. Kept to show why it needs a search before it.
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit binary_search(SurfaceRay ray, MarchParams params) {
    float above = ray.z_start;
    float below = ray.z_end;
    SurfaceHit hit;
    // A view ray ends at height 0, under every field. A shadow ray ends above the point it asks about, and there nothing
    // brackets a crossing until some midpoint turns out to be below the field.
    hit.found = ray.z_end <= 0.0f;
    for (int i = 0; i < params.refine_steps; ++i) {
        float z = 0.5f * (above + below);
        if (height_at(uv_at(ray, z)) >= z) {
            below = z;
            hit.found = true;
        } else {
            above = z;
        }
    }
    hit.height = below;
    hit.uv = uv_at(ray, below);
    return hit;
}
