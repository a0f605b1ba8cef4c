// Cone step mapping (Dummer 2006): each texel knows the widest empty cone above it; leap to that cone's wall.
// step = gap * c / (c + R), R the ray's UV speed per unit of descent. One fetch (height and cone together) a step.
// It never passes through the sampled field in theory; between samples the bilinear field can pierce the cone, and the walk
// stops short of the surface when it runs out of steps, most of all beside thin spikes.
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit cone_step_mapping(SurfaceRay ray, MarchParams params) {
    float speed = length(ray.uv_per_height);
    float z = ray.z_start;
    SurfaceHit hit;
    hit.found = false;
    bool inside = true;
    for (int i = 0; i < params.max_steps && inside && !hit.found; ++i) {
        vec2 height_cone = cone_at(uv_at(ray, z));
        float gap = z - height_cone.x;
        if (gap <= params.tolerance) {
            hit.found = true;
        } else {
            // A ratio quantised to 0 must not turn a vertical ray's step into 0/0; 1e-6 is far narrower than any texel.
            float ratio = max(height_cone.y, 1e-6f);
            z -= gap * ratio / (ratio + speed);
            inside = z > ray.z_end;
        }
    }
    // A view ray that ran out of steps shows where it stands; a shadow ray that did so met nothing.
    if (!hit.found && ray.z_end <= 0.0f) hit.found = true;
    hit.height = max(z, ray.z_end);
    hit.uv = uv_at(ray, hit.height);
    return hit;
}
