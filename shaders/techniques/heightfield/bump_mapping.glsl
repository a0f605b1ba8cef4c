// Bump mapping (Blinn 1978): a flat polygon whose normal is tilted by differences of the heights under the pixel.
// The search finds the polygon itself; the relief is only in the shading (shading/bump_normal.glsl), where it takes four fetches and
// no other map. Nothing moves, hides or shadows; between texels the normal is a little sharper than a normal map's.
#include "../../surface/ray_entry.glsl"

SurfaceHit bump_mapping(SurfaceRay ray, MarchParams params) {
    SurfaceHit hit;
    hit.uv = ray.uv;
    hit.height = ray.zero_level;
    hit.found = true;
    return hit;
}
