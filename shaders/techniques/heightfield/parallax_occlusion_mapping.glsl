// Parallax occlusion mapping (Tatarchuk 2006): a linear search with more steps the more grazing the view, then one secant
// between the last two samples, taking the field for a straight line. At most max_steps + 1 fetches: the ends of every step.
// Cheaper than bisection and smooth on smooth relief; on a step the straight line cuts the corner.
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit parallax_occlusion_mapping(SurfaceRay ray, MarchParams params) {
    int low = min(params.min_steps, params.max_steps);
    int steps = int(mix(float(params.max_steps), float(low), clamp(ray.view.z, 0.0f, 1.0f)) + 0.5f);
    SurfaceHit hit;
    hit.found = false;
    hit.height = ray.z_end;
    float z_before = ray.z_start;
    float gap_before = 0.0f;  // height of the ray over the field
    // The first sample is where the ray enters: without it the first step's secant has only one end, and everything that
    // stands within a step of the top, such as the faces of bricks, is seen a whole step too low.
    for (int i = 0; i <= steps && !hit.found; ++i) {
        float z = mix(ray.z_start, ray.z_end, float(i) / float(steps));
        float gap = z - height_at(uv_at(ray, z));
        if (gap <= 0.0f) {
            hit.found = true;
            // gap_before is positive here, but for the entry, where there is no step yet and z is z_before.
            hit.height = mix(z_before, z, gap_before / max(gap_before - gap, 1e-20f));
        }
        z_before = z;
        gap_before = gap;
    }
    hit.uv = uv_at(ray, hit.height);
    return hit;
}
