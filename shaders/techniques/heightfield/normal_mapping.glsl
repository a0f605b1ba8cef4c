// Normal mapping (Cohen, Olano, Manocha 1998): a flat polygon shaded with the normals of the detailed one.
// The search finds the polygon itself; the relief is only in the shading, so nothing moves, hides or shadows.
#include "../../surface/ray_entry.glsl"

SurfaceHit normal_mapping(SurfaceRay ray, MarchParams params) {
    SurfaceHit hit;
    hit.uv = ray.uv;
    hit.height = ray.zero_level;
    hit.found = true;
    return hit;
}
