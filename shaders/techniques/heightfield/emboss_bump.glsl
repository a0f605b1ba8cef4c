// Emboss bump mapping (Peeples, Michael 1999): a flat polygon whose diffuse light is the height here less the height a little toward
// the light. Made for texture units that could subtract but not multiply vectors: two fetches a light in the shading
// (shading/emboss.glsl), none in the search, which finds the polygon itself. No normal, so no highlight; slopes across the light go
// unseen, and steep ones burn out or go black.
#include "../../surface/ray_entry.glsl"

SurfaceHit emboss_bump(SurfaceRay ray, MarchParams params) {
    SurfaceHit hit;
    hit.uv = ray.uv;
    hit.height = ray.zero_level;
    hit.found = true;
    return hit;
}
