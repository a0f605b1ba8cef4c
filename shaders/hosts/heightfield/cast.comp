// The search alone on explicit rays. Some devices rasterise slowly but compute fast: casting is measured here, apart.
#include "../../shared/cast.h"
#include "maps.glsl"

layout(local_size_x = 64) in;
layout(set = 1, binding = 0, std430) readonly buffer Rays { CastRay rays[]; };
layout(set = 1, binding = 1, std430) writeonly buffer Hits { CastHit hits[]; };

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < rays.length()) {
        CastRay r = rays[i];
        SurfaceRay ray;
        ray.uv = vec2(r.u, r.v);
        ray.uv_per_height = vec2(r.u_per_height, r.v_per_height);
        ray.view = vec3(r.view_x, r.view_y, r.view_z);
        ray.height_scale = r.height_scale;
        ray.zero_level = r.zero_level;
        ray.z_start = r.z_start;
        ray.z_end = r.z_end;
        ray.lod = r.lod;
        SurfaceHit hit = technique(ray, march);
        hits[i] = CastHit(hit.uv.x, hit.uv.y, hit.height, hit.found ? 1 : 0, fetch_count);
    }
}
