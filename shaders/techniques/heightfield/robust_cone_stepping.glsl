// Robust cone step mapping (Ban, Valasek 2024): cones narrowed to the least of nine neighbours, standing on the surface itself instead
// of on a texel, and no step shorter than to the next cell's wall; so it neither enters sharp edges, as blended cones do, nor creeps
// beside spikes. The step that goes below the surface is bisected.
// Two fetches a step (the bilinear height, the nearest texel's cone), one a refinement. In rough relief the narrow cones hold nothing
// and it walks from cell to cell; a bilinear cell may still be entered and left between two of its walls.
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

// Descent to the next whole x, for a position x that changes by `speed` per unit of descent; 0 if it never comes. A thousandth of a
// cell further, so that rounding does not find the same wall again.
float descent_to_wall(float x, float speed) {
    float descent = 0.0f;
    if (speed > 0.0f) descent = (floor(x) + 1.001f - x) / speed;
    if (speed < 0.0f) descent = (x + floor(-x) + 1.001f) / -speed;
    return descent;
}

SurfaceHit robust_cone_stepping(SurfaceRay ray, MarchParams params) {
    ivec2 size = height_size();
    vec2 cells = vec2(-ray.uv_per_height.x * float(size.x), -ray.uv_per_height.y * float(size.y));  // per unit of descent
    float speed = length(ray.uv_per_height);
    float z = ray.z_start;
    float above = z;
    SurfaceHit hit;
    hit.found = false;
    bool inside = true;
    for (int i = 0; i < params.max_steps && inside && !hit.found; ++i) {
        vec2 uv = uv_at(ray, z);
        float gap = z - height_at(uv);
        if (gap <= 0.0f) {
            hit.found = true;
        } else {
            float x = uv.x * float(size.x);
            float y = uv.y * float(size.y);
            float ratio = max(robust_cone(ivec2(int(floor(x)), int(floor(y)))).y, 1e-6f);
            // Cells of the bilinear surface begin at texel centres.
            float wall_x = descent_to_wall(x - 0.5f, cells.x);
            float wall_y = descent_to_wall(y - 0.5f, cells.y);
            float wall = wall_x > 0.0f && (wall_y <= 0.0f || wall_x < wall_y) ? wall_x : wall_y;
            above = z;
            z -= max(gap * ratio / (ratio + speed), wall);
            inside = z > ray.z_end;
        }
    }
    // A view ray that left the slab went through the surface on the way; one that ran out of steps shows where it stands.
    bool bracketed = hit.found && z < above;
    if (!hit.found && ray.z_end <= 0.0f) {
        hit.found = true;
        bracketed = !inside;
    }
    float below = max(z, ray.z_end);
    if (bracketed) {
        for (int i = 0; i < params.refine_steps; ++i) {
            float middle = 0.5f * (above + below);
            if (height_at(uv_at(ray, middle)) >= middle) {
                below = middle;
            } else {
                above = middle;
            }
        }
    }
    hit.height = below;
    hit.uv = uv_at(ray, below);
    return hit;
}
