// Parallax mapping (Kaneko et al. 2001): shift by what a flat surface at the height found under the ray would show.
// One fetch. Right only where the height does not change between the two points; at grazing angles the shift explodes.
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit parallax_mapping(SurfaceRay ray, MarchParams params) {
    SurfaceHit hit;
    hit.height = height_at(ray.uv);
    hit.uv = uv_at(ray, hit.height);
    hit.found = true;
    return hit;
}
