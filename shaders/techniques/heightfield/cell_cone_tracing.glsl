// Cell cone tracing: leap to the wall of a cone that holds nothing of the declared surface wherever in the cell it stands, or through
// a roof over the cells around where that leads farther; where neither leaves the cell, step to the next one, and solve the bilinear
// patch of a cell the ray may touch. The declared surface's first hit, up to float rounding, whatever the field (exact_casting in the
// docs says why). One fetch a leap or step, one more a solved cell. Loses to the maximum pyramid only where spikes stand so close that
// every leap is short, and needs four channels where the pyramid needs one.
#include "../../surface/cell_hit.glsl"
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit cell_cone_tracing(SurfaceRay ray, MarchParams params) {
    CellRay r = cell_ray(ray, height_size());
    float uv_speed = length(ray.uv_per_height);
    vec2 first_wall = vec2((1.0f - r.offset.x) * r.rise.x, (1.0f - r.offset.y) * r.rise.y);
    vec2 under_near_roof = vec2(float(near_roof_reach) * r.rise.x, float(near_roof_reach) * r.rise.y);
    vec2 under_far_roof = vec2(float(far_roof_reach) * r.rise.x, float(far_roof_reach) * r.rise.y);

    // Skips are biased by a few units in the last place of a height near 1, which covers what rounding does to descents and places.
    float margin = 4e-7f;
    float above = ray.z_start - margin;  // descents to a height are taken from here
    float descent_end = ray.z_start - ray.z_end;
    float descent = 0.0f;
    vec2 cell = floor(r.offset);
    int fetches = 0;
    bool inside = true;
    SurfaceHit hit;
    hit.found = false;
    hit.height = ray.z_end;
    // One loop, tested at its end: machines that run rays in step pay for the body of every loop once more than the longest ray needs,
    // and for both sides of a branch.
    do {
        vec4 over = cell_cone(map_cell(r, cell));
        ++fetches;
        vec2 wall = vec2(cell.x * r.rise.x + first_wall.x, cell.y * r.rise.y + first_wall.y);  // descents at the cell's far walls
        float leave = min(wall.x, wall.y);
        float cone = descent + (above - descent - over.x) * (over.y / (over.y + uv_speed)) - margin;
        float near_roof = min(min(wall.x + under_near_roof.x, wall.y + under_near_roof.y), above - over.z);
        float far_roof = min(min(wall.x + under_far_roof.x, wall.y + under_far_roof.y), above - over.w);
        float leap = max(cone, max(near_roof, far_roof));
        if (leap <= leave && above - min(leave, descent_end) <= over.x && fetches < params.max_steps) {
            ++fetches;
            float z = cell_hit(ray, r, height_cell(map_cell(r, cell)), cell, descent);
            if (z >= 0.0f) {
                hit.found = true;
                hit.height = z;
            }
        }
        float reached = max(max(leap, leave), descent);
        inside = reached < descent_end;
        cell = vec2(wall.x <= reached ? max(cell.x + 1.0f, floor(r.offset.x + r.pace.x * reached)) : cell.x,
                    wall.y <= reached ? max(cell.y + 1.0f, floor(r.offset.y + r.pace.y * reached)) : cell.y);
        descent = reached;
    } while (inside && !hit.found && fetches < params.max_steps);
    // Every field is at least 0, so a view ray that reaches the floor (or runs out of steps) has met it.
    if (!hit.found && ray.z_end <= 0.0f) {
        hit.found = true;
        hit.height = inside ? max(ray.z_start - descent, ray.z_end) : ray.z_end;
    }
    hit.uv = uv_at(ray, hit.height);
    return hit;
}
