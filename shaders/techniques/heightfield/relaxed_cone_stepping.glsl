// Relaxed cone stepping (Policarpo, Oliveira 2007): cones so wide that a ray may enter the surface inside one, but not leave it again;
// so leaps are long, and the first that ends below the surface brackets the hit for bisection.
// One fetch (height and cone together) a step or refinement. The cones are right over texels; blended between them they can be too
// wide, and a thin ridge or sharp edge is then passed. On level ground, where no leap ends below, it creeps to the tolerance.
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit relaxed_cone_stepping(SurfaceRay ray, MarchParams params) {
    float speed = length(ray.uv_per_height);
    float z = ray.z_start;
    float above = z;
    SurfaceHit hit;
    hit.found = false;
    bool bracketed = false;
    bool inside = true;
    for (int i = 0; i < params.max_steps && inside && !hit.found; ++i) {
        vec2 height_cone = relaxed_cone_at(uv_at(ray, z));
        float gap = z - height_cone.x;
        if (gap <= params.tolerance) {
            hit.found = true;
            bracketed = gap < 0.0f;
        } else {
            above = z;
            // A ratio quantised to 0 must not turn a vertical ray's step into 0/0; 1e-6 is far narrower than any texel.
            float ratio = max(height_cone.y, 1e-6f);
            z -= gap * ratio / (ratio + speed);
            inside = z > ray.z_end;
        }
    }
    // A view ray that left the slab went through the surface on the way; one that ran out of steps shows where it stands. A shadow ray
    // that did either met nothing: it ends above the surface, and what it had entered it would not have left.
    if (!hit.found && ray.z_end <= 0.0f) {
        hit.found = true;
        bracketed = !inside;
    }
    float below = max(z, ray.z_end);
    if (bracketed) {
        for (int i = 0; i < params.refine_steps; ++i) {
            float middle = 0.5f * (above + below);
            if (relaxed_cone_at(uv_at(ray, middle)).x >= middle) {
                below = middle;
            } else {
                above = middle;
            }
        }
    }
    hit.height = below;
    hit.uv = uv_at(ray, below);
    return hit;
}
