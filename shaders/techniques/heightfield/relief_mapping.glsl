// Relief mapping (Policarpo, Oliveira, Comba 2005): a linear search brackets the surface, bisection refines the bracket.
// At most max_steps + refine_steps fetches. The first search still steps over thin features; what it finds is sharp.
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit relief_mapping(SurfaceRay ray, MarchParams params) {
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
        for (int i = 0; i < params.refine_steps; ++i) {
            float z = 0.5f * (above + below);
            if (height_at(uv_at(ray, z)) >= z) {
                below = z;
            } else {
                above = z;
            }
        }
    }
    hit.height = below;
    hit.uv = uv_at(ray, below);
    return hit;
}
