// Maximum mipmap tracing (Tevs, Ihrke, Seidel 2008): walk a pyramid of cell maxima, skip every node the ray stays above, and
// solve the bilinear patch in each cell it may touch. The declared surface's first hit, up to float rounding, whatever the
// field; one fetch a node. Costs more the more grazing the ray and the spikier the field, never correctness, unless max_steps
// ends the walk.
#include "../../surface/cell_hit.glsl"
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

// A cell's index along one axis of the map, of `cells` from the first along the way. The quotient is taken at the cell's middle, where its
// rounding does not count; an integer remainder would cost more than a fetch.
int index_in_period(int first, int turn, float cells, int size) {
    int i = first + turn * int(cells);
    return i - size * int(floor((float(i) + 0.5f) / float(size)));
}

// Cells from this one to the node's far wall, along the way; the last node of a period may be cut short.
float cells_to_wall(int index, int turn, int level, int size) {
    int node = index >> level;
    return float(turn > 0 ? min((node + 1) << level, size) - index : index - (node << level) + 1);
}

SurfaceHit max_mip_tracing(SurfaceRay ray, MarchParams params) {
    ivec2 size = height_size();
    CellRay r = cell_ray(ray, size);
    vec2 first_wall = vec2((1.0f - r.offset.x) * r.rise.x, (1.0f - r.offset.y) * r.rise.y);

    // Skips are biased by a few units in the last place of a height near 1: a node within that of the ray is opened.
    float above = ray.z_start - 4e-7f;  // descents to a height are taken from here
    float descent_end = ray.z_start - ray.z_end;
    // Nodes much longer than the ray's whole way hardly ever lie below it: begin, and stay, where a node holds at least an
    // eighth of the way. Against starting at the top this saves 5 to 20 % of the fetches.
    float way = max(r.pace.x, r.pace.y) * descent_end;
    int top = 0;
    while (top < max_levels() - 1 && float(8 << top) < way) ++top;
    int level = top;

    vec2 cell = floor(r.offset);
    float descent = 0.0f;
    int fetches = 0;
    SurfaceHit hit;
    hit.found = false;
    hit.height = ray.z_end;
    do {
        ivec2 index = ivec2(index_in_period(r.cell.x, r.turn.x, cell.x, size.x), index_in_period(r.cell.y, r.turn.y, cell.y, size.y));
        vec2 span = vec2(cells_to_wall(index.x, r.turn.x, level, size.x), cells_to_wall(index.y, r.turn.y, level, size.y));
        vec2 wall = vec2((cell.x + span.x - 1.0f) * r.rise.x + first_wall.x, (cell.y + span.y - 1.0f) * r.rise.y + first_wall.y);
        float leave = min(wall.x, wall.y);

        ++fetches;
        vec4 corners = vec4(0.0f);
        float highest = 0.0f;
        if (level == 0) {
            corners = height_cell(cell_middle(r, cell));
            highest = max(max(corners.x, corners.y), max(corners.z, corners.w));
        } else {
            highest = max_at(ivec2(index.x >> level, index.y >> level), level);
        }
        bool clear = above - min(leave, descent_end) > highest;
        bool open = !clear && level > 0;
        if (!clear && level == 0) {
            float z = cell_hit(ray, r, corners, cell, descent);
            if (z >= 0.0f) {
                hit.found = true;
                hit.height = z;
            }
        }

        // Into the node, where the ray comes down to its top, or out of it. What was passed is not taken back.
        descent = max(descent, open ? above - highest : leave);
        vec2 there = vec2(clamp(floor(r.offset.x + r.pace.x * descent), cell.x, cell.x + span.x - 1.0f),
                          clamp(floor(r.offset.y + r.pace.y * descent), cell.y, cell.y + span.y - 1.0f));
        if (!open && wall.x <= leave) there.x = cell.x + span.x;
        if (!open && wall.y <= leave) there.y = cell.y + span.y;
        // Go up only on leaving the parent, which was opened for a reason.
        ivec2 moved = ivec2(index.x + r.turn.x * int(there.x - cell.x), index.y + r.turn.y * int(there.y - cell.y));
        bool same_parent = moved.x >= 0 && moved.x < size.x && moved.y >= 0 && moved.y < size.y &&
                           (moved.x >> (level + 1)) == (index.x >> (level + 1)) && (moved.y >> (level + 1)) == (index.y >> (level + 1));
        level = open ? level - 1 : (same_parent || level >= top ? level : level + 1);
        cell = there;
    } while (descent < descent_end && !hit.found && fetches < params.max_steps);
    // Every field is at least 0, so a view ray that reaches the floor (or runs out of steps) has met it.
    if (!hit.found && ray.z_end <= 0.0f) {
        hit.found = true;
        hit.height = max(ray.z_start - descent, ray.z_end);
    }
    hit.uv = uv_at(ray, hit.height);
    return hit;
}
