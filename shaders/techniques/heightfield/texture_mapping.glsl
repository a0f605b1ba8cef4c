// Texture mapping (Catmull 1974): the colour under the ray, on a flat polygon.
// Needs nothing. Shows no relief at all; it is the floor of every comparison.
#include "../../surface/ray_entry.glsl"

SurfaceHit texture_mapping(SurfaceRay ray, MarchParams params) {
    SurfaceHit hit;
    hit.uv = ray.uv;
    hit.height = ray.zero_level;
    hit.found = true;
    return hit;
}
