// Contact refinement parallax mapping (Riccardi 2019): a linear search; where a step ends below the field, go back to its beginning
// and search it again in contact_steps shorter steps; so refine_steps times. The resolution of max_steps * contact_steps^refine_steps
// steps for max_steps + refine_steps * (contact_steps - 1) fetches. Unlike bisection it keeps looking from the eye's side, so that
// of several crossings in a step the first is found if the shorter steps see it.
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit contact_refinement(SurfaceRay ray, MarchParams params) {
    SurfaceHit hit;
    hit.found = false;
    float above = ray.z_start;
    float below = ray.z_end;
    for (int i = 1; i <= params.max_steps && !hit.found; ++i) {
        float z = mix(ray.z_start, ray.z_end, float(i) / float(params.max_steps));
        if (height_at(uv_at(ray, z)) >= z) {
            hit.found = true;
            below = z;
        } else {
            above = z;
        }
    }
    if (hit.found) {
        for (int contact = 0; contact < params.refine_steps; ++contact) {
            float first = above;
            float last = below;
            // That the last of the shorter steps ends below the field is known.
            for (int i = 1; i < params.contact_steps && below == last; ++i) {
                float z = mix(first, last, float(i) / float(params.contact_steps));
                if (height_at(uv_at(ray, z)) >= z) {
                    below = z;
                } else {
                    above = z;
                }
            }
        }
    }
    hit.height = below;
    hit.uv = uv_at(ray, below);
    return hit;
}
