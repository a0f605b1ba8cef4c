// Maximum mipmap tracing (Tevs, Ihrke, Seidel 2008): walk a pyramid of cell maxima, skip every node the ray stays above, and
// solve the bilinear patch in each cell it may touch. The declared surface's first hit, up to float rounding, whatever the
// field; one fetch a node. Costs more the more grazing the ray and the spikier the field, never correctness, unless max_steps
// ends the walk.
#include "../../surface/bilinear_patch.glsl"
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit max_mip_tracing(SurfaceRay ray, MarchParams params) {
    ivec2 size = height_size();
    vec2 texels = vec2(float(size.x), float(size.y));
    vec2 speed = vec2(0.0f, 0.0f) - ray.uv_per_height * texels;  // cells per unit of descent
    vec2 start = uv_at(ray, ray.z_start) * texels - vec2(0.5f, 0.5f);

    // The cell is kept in integers and the position relative to the first cell, so that rounding never loses a cell and does
    // not grow with the distance from the texture's origin.
    ivec2 origin = ivec2(int(floor(start.x)), int(floor(start.y)));
    vec2 offset = start - vec2(float(origin.x), float(origin.y));
    ivec2 cell = ivec2(0, 0);  // relative to origin

    // Skips are biased by a few units in the last place of a height near 1: a node within that of the ray is opened.
    float margin = 4e-7f;
    float never = 1e30f;
    float descent_end = ray.z_start - ray.z_end;
    float descent = 0.0f;
    int top = max_levels() - 1;
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
            corners = height_cell(ivec2(origin.x + cell.x, origin.y + cell.y));
            top_of_node = max(max(corners.x, corners.y), max(corners.z, corners.w));
        } else {
            top_of_node = max_at(node, level);
        }

        bool skip = z_leave - margin > top_of_node;
        if (!skip && level == 0) {
            vec2 entry = vec2(clamp(offset.x + speed.x * descent - float(cell.x), 0.0f, 1.0f),
                              clamp(offset.y + speed.y * descent - float(cell.y), 0.0f, 1.0f));
            float root = patch_descent(corners, entry, ray.z_start - descent, speed, min(leave, descent_end) - descent);
            if (root >= 0.0f) {
                hit.found = true;
                hit.height = ray.z_start - (descent + root);
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
        hit.height = inside ? ray.z_start - descent : ray.z_end;
    }
    hit.uv = uv_at(ray, hit.height);
    return hit;
}
