// Interval mapping (Risser, Shah, Pattanaik 2005): a linear search brackets the surface; then the chord between the two ends, which
// knows how far each is from the surface, says where to look next, and one end moves there (false position).
// At most max_steps + 1 + refine_steps fetches. Two or three secants do what bisection does in six on smooth relief; across a sheer
// step one end stays where it is and the other creeps. The first search still steps over thin features.
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit interval_mapping(SurfaceRay ray, MarchParams params) {
    SurfaceHit hit;
    hit.found = false;
    hit.height = ray.z_end;
    float above = ray.z_start;
    float below = ray.z_end;
    float gap_above = 0.0f;  // height of the ray over the field: positive above, negative below
    float gap_below = 0.0f;
    for (int i = 0; i <= params.max_steps && !hit.found; ++i) {
        float z = mix(ray.z_start, ray.z_end, float(i) / float(params.max_steps));
        float gap = z - height_at(uv_at(ray, z));
        if (gap <= 0.0f) {
            hit.found = true;
            below = z;
            gap_below = gap;
        } else {
            above = z;
            gap_above = gap;
        }
    }
    // Met at the entry, the ray has no end above and `below` is the hit.
    if (hit.found && below < above) {
        for (int i = 0; i < params.refine_steps; ++i) {
            float z = mix(above, below, gap_above / (gap_above - gap_below));
            float gap = z - height_at(uv_at(ray, z));
            if (gap <= 0.0f) {
                below = z;
                gap_below = gap;
            } else {
                above = z;
                gap_above = gap;
            }
        }
        below = mix(above, below, gap_above / max(gap_above - gap_below, 1e-20f));
    }
    if (hit.found) hit.height = below;
    hit.uv = uv_at(ray, hit.height);
    return hit;
}
