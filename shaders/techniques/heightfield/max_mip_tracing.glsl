// Maximum mipmap tracing (Tevs, Ihrke, Seidel 2008): walk a pyramid of cell maxima, skip every node the ray stays above, and
// solve the bilinear patch in each cell it may touch. The declared surface's first hit, up to float rounding, whatever the
// field; one fetch a node. Costs more the more grazing the ray and the spikier the field, never correctness, unless max_steps
// ends the walk.
#include "../../surface/bilinear_patch.glsl"
#include "../../surface/cell_position.glsl"
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit max_mip_tracing(SurfaceRay ray, MarchParams params) {
    ivec2 size = height_size();
    vec2 speed = vec2(-ray.uv_per_height.x * float(size.x), -ray.uv_per_height.y * float(size.y));  // cells per unit of descent

    // The cell is kept in integers and the position relative to the first cell, so that rounding never loses a cell and does
    // not grow with the distance from the texture's origin.
    CellPosition start_x = cell_position(ray.uv.x, ray.uv_per_height.x, ray.zero_level - ray.z_start, size.x);
    CellPosition start_y = cell_position(ray.uv.y, ray.uv_per_height.y, ray.zero_level - ray.z_start, size.y);
    ivec2 origin = ivec2(start_x.cell, start_y.cell);
    vec2 offset = vec2(start_x.inside, start_y.inside);
    ivec2 cell = ivec2(int(floor(offset.x)), int(floor(offset.y)));  // relative to origin

    // Skips are biased by a few units in the last place of a height near 1: a node within that of the ray is opened.
    float margin = 4e-7f;
    float never = 1e30f;
    float descent_end = ray.z_start - ray.z_end;
    float descent = 0.0f;
    // Nodes much longer than the ray's whole way hardly ever lie below it: begin, and stay, where a node holds at least an
    // eighth of the way. Against starting at the top this saves 5 to 20 % of the fetches.
    float way = max(abs(speed.x), abs(speed.y)) * descent_end;
    int top = 0;
    while (top < max_levels() - 1 && float(8 << top) < way) ++top;
    int level = top;

    SurfaceHit hit;
    hit.found = false;
    hit.height = ray.z_end;
    bool inside = true;
    for (int i = 0; i < params.max_steps && inside && !hit.found; ++i) {
        // The node of this level that holds the cell, in one period, and its walls relative to origin.
        ivec2 wrapped = ivec2((origin.x + cell.x) % size.x, (origin.y + cell.y) % size.y);
        if (wrapped.x < 0) wrapped.x += size.x;
        if (wrapped.y < 0) wrapped.y += size.y;
        ivec2 node = ivec2(wrapped.x >> level, wrapped.y >> level);
        ivec2 low = ivec2(cell.x - wrapped.x + (node.x << level), cell.y - wrapped.y + (node.y << level));
        ivec2 high = ivec2(min(low.x + (1 << level), cell.x - wrapped.x + size.x),
                           min(low.y + (1 << level), cell.y - wrapped.y + size.y));

        float exit_x = never;
        float exit_y = never;
        if (speed.x > 0.0f) exit_x = (float(high.x) - offset.x) / speed.x;
        if (speed.x < 0.0f) exit_x = (float(low.x) - offset.x) / speed.x;
        if (speed.y > 0.0f) exit_y = (float(high.y) - offset.y) / speed.y;
        if (speed.y < 0.0f) exit_y = (float(low.y) - offset.y) / speed.y;
        float leave = max(min(exit_x, exit_y), descent);
        float z_leave = ray.z_start - min(leave, descent_end);

        vec4 corners = vec4(0.0f);
        float top_of_node = 0.0f;
        if (level == 0) {
            corners = height_cell(vec2((float(wrapped.x) + 1.0f) / float(size.x), (float(wrapped.y) + 1.0f) / float(size.y)));
            top_of_node = max(max(corners.x, corners.y), max(corners.z, corners.w));
        } else {
            top_of_node = max_at(node, level);
        }

        bool skip = z_leave - margin > top_of_node;
        if (!skip && level == 0) {
            // The walk's own position is good enough to choose cells, whose surfaces join, but not to solve one.
            float z = ray.z_start - descent;
            CellPosition x = cell_position(ray.uv.x, ray.uv_per_height.x, ray.zero_level - z, size.x);
            CellPosition y = cell_position(ray.uv.y, ray.uv_per_height.y, ray.zero_level - z, size.y);
            vec2 here = vec2(float(x.cell - origin.x - cell.x) + x.inside, float(y.cell - origin.y - cell.y) + y.inside);
            // Descents from here at which the ray enters and leaves the cell; it entered before `here` where an opened node
            // had the walk begin inside, or by rounding.
            float enter = -descent;
            float exit = descent_end - descent;
            if (speed.x != 0.0f) {
                enter = max(enter, ((speed.x > 0.0f ? 0.0f : 1.0f) - here.x) / speed.x);
                exit = min(exit, ((speed.x > 0.0f ? 1.0f : 0.0f) - here.x) / speed.x);
            }
            if (speed.y != 0.0f) {
                enter = max(enter, ((speed.y > 0.0f ? 0.0f : 1.0f) - here.y) / speed.y);
                exit = min(exit, ((speed.y > 0.0f ? 1.0f : 0.0f) - here.y) / speed.y);
            }
            if (enter <= exit) {
                vec2 entry = vec2(clamp(here.x + speed.x * enter, 0.0f, 1.0f), clamp(here.y + speed.y * enter, 0.0f, 1.0f));
                float root = patch_descent(corners, entry, z - enter, speed, exit - enter);
                if (root >= 0.0f) {
                    hit.found = true;
                    hit.height = z - (enter + root);
                }
            }
            skip = true;
        }
        if (!skip) {
            // Open the node where the ray comes down to its top; walls already passed are not taken back.
            float down = ray.z_start - top_of_node - margin;
            if (down > descent) {
                descent = down;
                int x = int(floor(offset.x + speed.x * descent));
                int y = int(floor(offset.y + speed.y * descent));
                cell.x = speed.x >= 0.0f ? clamp(x, cell.x, high.x - 1) : clamp(x, low.x, cell.x);
                cell.y = speed.y >= 0.0f ? clamp(y, cell.y, high.y - 1) : clamp(y, low.y, cell.y);
            }
            --level;
        } else if (!hit.found) {
            descent = leave;
            inside = descent < descent_end;
            ivec2 before = ivec2(wrapped.x >> (level + 1), wrapped.y >> (level + 1));
            ivec2 moved = cell;
            if (exit_x <= exit_y) {
                moved.x = speed.x > 0.0f ? high.x : low.x - 1;
                int y = int(floor(offset.y + speed.y * min(descent, descent_end)));
                moved.y = speed.y >= 0.0f ? clamp(y, cell.y, high.y - 1) : clamp(y, low.y, cell.y);
            } else {
                moved.y = speed.y > 0.0f ? high.y : low.y - 1;
                int x = int(floor(offset.x + speed.x * min(descent, descent_end)));
                moved.x = speed.x >= 0.0f ? clamp(x, cell.x, high.x - 1) : clamp(x, low.x, cell.x);
            }
            // Go up only on leaving the parent, which was opened for a reason.
            ivec2 after = ivec2(wrapped.x + moved.x - cell.x, wrapped.y + moved.y - cell.y);
            bool same_parent = after.x >= 0 && after.x < size.x && after.y >= 0 && after.y < size.y &&
                               (after.x >> (level + 1)) == before.x && (after.y >> (level + 1)) == before.y;
            if (!same_parent && level < top) ++level;
            cell = moved;
        }
    }
    // Every field is at least 0, so a view ray that reaches the floor (or runs out of steps) has met it.
    if (!hit.found && ray.z_end <= 0.0f) {
        hit.found = true;
        hit.height = inside ? max(ray.z_start - descent, ray.z_end) : ray.z_end;
    }
    hit.uv = uv_at(ray, hit.height);
    return hit;
}
