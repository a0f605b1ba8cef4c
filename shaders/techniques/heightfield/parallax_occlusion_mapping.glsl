// Parallax occlusion mapping (Tatarchuk 2006): a linear search with more steps the more grazing the view, then one secant
// between the last two samples, taking the field for a straight line. At most max_steps fetches.
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
    float gap_before = 0.0f;  // height of the ray over the field; the slab's top touches the field at worst
    bool known_before = false;
    for (int i = 1; i <= steps && !hit.found; ++i) {
        float z = mix(ray.z_start, ray.z_end, float(i) / float(steps));
        float gap = z - height_at(uv_at(ray, z));
        if (gap <= 0.0f) {
            hit.found = true;
            // Before the first sample only the bound gap >= 0 is known, so the sample itself is the best guess.
            float t = known_before ? gap_before / (gap_before - gap) : 1.0f;
            hit.height = mix(z_before, z, t);
        }
        z_before = z;
        gap_before = gap;
        known_before = true;
    }
    hit.uv = uv_at(ray, hit.height);
    return hit;
}
