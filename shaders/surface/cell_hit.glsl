// A ray as a walk over the cells of a map, and its first point on one of them. The walk is turned so that it never goes back along an
// axis, and kept relative to the first cell: cells are whole numbers, and rounding neither loses one nor grows with the distance
// from the texture's origin.
#ifndef RELIEVO_SURFACE_CELL_HIT
#define RELIEVO_SURFACE_CELL_HIT
#include "bilinear_patch.glsl"
#include "cell_position.glsl"

struct CellRay {
    ivec2 cell;      // in which the ray starts, inside one period
    vec2 corner;     // UV of the texel that is its first corner
    vec2 uv_per_cell;
    ivec2 turn;      // 1, or -1 along an axis that the ray goes down
    vec2 offset;     // the start in the first cell, turned; within 1 of [0,1)
    vec2 pace;       // cells per unit of descent, >= 0
    vec2 pace_high;  // leading digits of the exact pace
    vec2 pace_low;   // and what they leave
    vec2 rise;       // descent per cell; along an axis that is hardly moved along the next wall is never reached
};

// The leading 12 binary digits of a pace below 2^18.
float leading_digits(float pace) {
    float grid = pace < 64.0f ? 64.0f : (pace < 4096.0f ? 1.0f : (pace < 16384.0f ? 0.25f : 0.015625f));
    return floor(pace * grid) / grid;
}

// |uv_per_height| * texels less `high`, without the rounding of the product: its first factor is split so that one part's is exact.
float pace_beyond(float high, float uv_per_height, float texels) {
    float lead = floor(uv_per_height * 512.0f) / 512.0f;
    return (lead * texels - high) + (uv_per_height - lead) * texels;
}

CellRay cell_ray(SurfaceRay ray, ivec2 size) {
    CellPosition x = cell_position(ray.uv.x, ray.uv_per_height.x, ray.zero_level - ray.z_start, size.x);
    CellPosition y = cell_position(ray.uv.y, ray.uv_per_height.y, ray.zero_level - ray.z_start, size.y);
    vec2 texels = vec2(float(size.x), float(size.y));
    vec2 uv_pace = vec2(abs(ray.uv_per_height.x), abs(ray.uv_per_height.y));
    CellRay r;
    // Moved into one period as whole cells, so that places stay well inside their texels however far the ray starts from the origin.
    r.turn = ivec2(ray.uv_per_height.x > 0.0f ? -1 : 1, ray.uv_per_height.y > 0.0f ? -1 : 1);
    r.uv_per_cell = vec2(float(r.turn.x) / texels.x, float(r.turn.y) / texels.y);
    r.cell = ivec2(x.cell - size.x * int(floor(float(x.cell) / texels.x)), y.cell - size.y * int(floor(float(y.cell) / texels.y)));
    r.corner = vec2((float(r.cell.x) + 0.5f) / texels.x, (float(r.cell.y) + 0.5f) / texels.y);
    r.offset = vec2(r.turn.x < 0 ? 1.0f - x.inside : x.inside, r.turn.y < 0 ? 1.0f - y.inside : y.inside);
    r.pace = vec2(uv_pace.x * texels.x, uv_pace.y * texels.y);
    r.pace_high = vec2(leading_digits(r.pace.x), leading_digits(r.pace.y));
    r.pace_low = vec2(pace_beyond(r.pace_high.x, uv_pace.x, texels.x), pace_beyond(r.pace_high.y, uv_pace.y, texels.y));
    r.rise = vec2(r.pace.x > 1e-6f ? 1.0f / r.pace.x : 1e30f, r.pace.y > 1e-6f ? 1.0f / r.pace.y : 1e30f);
    return r;
}

// UV of a cell's first corner and of its middle, of a turned, relative cell.
vec2 cell_corner(CellRay r, vec2 cell) { return vec2(r.corner.x + r.uv_per_cell.x * cell.x, r.corner.y + r.uv_per_cell.y * cell.y); }
vec2 cell_middle(CellRay r, vec2 cell) {
    vec2 corner = cell_corner(r, cell);
    return vec2(corner.x + 0.5f * abs(r.uv_per_cell.x), corner.y + 0.5f * abs(r.uv_per_cell.y));
}

// Height at which the ray first meets a cell, or -1. corners as height_cell gives them for cell_middle(r, cell); descent = some descent
// since z_start near the cell. Choosing cells, whose surfaces join, takes plain products; solving one does not: the place is offset +
// pace * descent to a few 1e-7 of a cell, because the product of two numbers of 12 digits is exact and the rest is small. No step
// relies on the compiler keeping an order of float operations.
float cell_hit(SurfaceRay ray, CellRay r, vec4 corners, vec2 cell, float descent) {
    vec2 low = r.turn.x > 0 ? vec2(corners.x, corners.y) : vec2(corners.y, corners.x);
    vec2 high = r.turn.x > 0 ? vec2(corners.z, corners.w) : vec2(corners.w, corners.z);
    vec2 near = r.turn.y > 0 ? low : high;
    vec2 far = r.turn.y > 0 ? high : low;
    float lead = floor(descent * 2048.0f) / 2048.0f;
    float rest = descent - lead;
    vec2 here = vec2(r.offset.x + ((r.pace_high.x * lead - cell.x) + (r.pace_high.x * rest + r.pace_low.x * descent)),
                     r.offset.y + ((r.pace_high.y * lead - cell.y) + (r.pace_high.y * rest + r.pace_low.y * descent)));
    // Descents from here at which the ray enters and leaves the cell; it entered before where a skip had the walk begin inside, or by
    // rounding.
    float z = ray.z_start - descent;
    bool moves_x = r.rise.x < 1e30f;
    bool moves_y = r.rise.y < 1e30f;
    float enter = max(-descent, max(moves_x ? -here.x * r.rise.x : -1e30f, moves_y ? -here.y * r.rise.y : -1e30f));
    float exit = min(z - ray.z_end, min(moves_x ? (1.0f - here.x) * r.rise.x : 1e30f, moves_y ? (1.0f - here.y) * r.rise.y : 1e30f));
    vec2 entry = vec2(clamp(here.x + r.pace.x * enter, 0.0f, 1.0f), clamp(here.y + r.pace.y * enter, 0.0f, 1.0f));
    float root = patch_descent(vec4(near.x, near.y, far.x, far.y), entry, z - enter, r.pace, exit - enter);
    return enter <= exit && root >= 0.0f ? max(z - (enter + root), 0.0f) : -1.0f;
}

#endif
