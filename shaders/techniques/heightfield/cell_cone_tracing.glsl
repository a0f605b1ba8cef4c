// Cell cone tracing: leap under the highest of the roofs over the cells ahead, in the quadrant the ray goes to, that it clears; where
// none of them leads out of the cell, step to the next one, and solve the bilinear patch of a cell the ray may touch. The declared
// surface's first hit, up to float rounding, whatever the field (exact_casting in the docs says why). One fetch a leap or step, one
// more a solved cell, and one a cell of the last few. Needs sixteen numbers a texel where the maximum pyramid needs one and a third.
#include "../../surface/cell_hit.glsl"
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit cell_cone_tracing(SurfaceRay ray, MarchParams params) {
    CellRay r = cell_ray(ray, height_size());
    int quadrant = (r.turn.x < 0 ? 1 : 0) + (r.turn.y < 0 ? 2 : 0);
    // Descents to the far walls of the cell (0, 0), and how much farther those of its roofs' squares are.
    vec2 first_wall = vec2((1.0f - r.offset.x) * r.rise.x, (1.0f - r.offset.y) * r.rise.y);
    vec2 near_walls = vec2(float(near_roof_reach) * r.rise.x, float(near_roof_reach) * r.rise.y);
    vec2 middle_walls = vec2(float(middle_roof_reach) * r.rise.x, float(middle_roof_reach) * r.rise.y);
    vec2 far_walls = vec2(float(far_roof_reach) * r.rise.x, float(far_roof_reach) * r.rise.y);

    // Skips are biased by a few units in the last place of a height near 1, which covers what rounding does to descents and places.
    float above = ray.z_start - 4e-7f;  // descents to a height are taken from here
    float descent_end = ray.z_start - ray.z_end;
    // Most leaps end on a wall, and are to go on behind it: ways are taken longer by more than their rounding.
    vec2 pace = vec2(r.pace.x * 1.0000002f, r.pace.y * 1.0000002f);
    // Near the end there is little to leap over, and the cells' own corners, which solve them too, are asked at once. With four cells, along
    // both axes together, shallow relief seen from above still took 1.8 times the pyramid's fetches; with eight as many.
    const float last_cells = 8.0f;
    float cells_per_descent = r.pace.x + r.pace.y;
    vec2 cell = floor(r.offset);
    float descent = 0.0f;
    int fetches = 0;
    SurfaceHit hit;
    hit.found = false;
    hit.height = ray.z_end;
    // One loop, tested at its end: machines that run rays in step pay for the body of every loop once more than the longest ray needs,
    // and for both sides of a branch.
    do {
        vec4 roof = vec4(1.0f);
        if ((descent_end - descent) * cells_per_descent > last_cells) {
            roof = cell_cone(cell_corner(r, cell), quadrant);
            ++fetches;
        }
        vec2 wall = vec2(cell.x * r.rise.x + first_wall.x, cell.y * r.rise.y + first_wall.y);
        float leave = min(wall.x, wall.y);
        if (above - min(leave, descent_end) <= roof.x && fetches < params.max_steps) {
            ++fetches;
            float z = cell_hit(ray, r, height_cell(cell_middle(r, cell)), cell, descent);
            if (z >= 0.0f) {
                hit.found = true;
                hit.height = z;
            }
        }
        // Out of the cell, or as far as a roof leads: to the far walls of its square or to where the ray comes down to it.
        float near = min(min(wall.x + near_walls.x, wall.y + near_walls.y), above - roof.y);
        float middle = min(min(wall.x + middle_walls.x, wall.y + middle_walls.y), above - roof.z);
        float far = min(min(wall.x + far_walls.x, wall.y + far_walls.y), above - roof.w);
        descent = max(max(leave, near), max(middle, far));
        cell = vec2(max(wall.x <= descent ? cell.x + 1.0f : cell.x, floor(r.offset.x + pace.x * descent)),
                    max(wall.y <= descent ? cell.y + 1.0f : cell.y, floor(r.offset.y + pace.y * descent)));
    } while (descent < descent_end && !hit.found && fetches < params.max_steps);
    // Every field is at least 0, so a view ray that reaches the floor (or runs out of steps) has met it.
    if (!hit.found && ray.z_end <= 0.0f) {
        hit.found = true;
        hit.height = max(ray.z_start - descent, ray.z_end);
    }
    hit.uv = uv_at(ray, hit.height);
    return hit;
}
