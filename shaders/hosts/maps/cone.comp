// Which other texel limits the cone over a texel: the one whose squared distance over its squared rise is least (maps/cone_map.h). A
// walk down a pyramid of maxima, near nodes first; a node is closed once no texel in it could be the one. Quotients are only estimated, to
// close nodes with room to spare; which of two is less is decided by products of whole numbers, so that the answer is exact, and
// the CPU divides and takes the root.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../../shared/cone_bake.h"

layout(local_size_x = 8, local_size_y = 8) in;  // neighbours walk alike
layout(push_constant) uniform Step { ConeStep now; };
layout(set = 0, binding = 0, std430) readonly buffer Maxima { float maxima[]; };    // of 2^k x 2^k texels, level after level
layout(set = 0, binding = 1, std430) readonly buffer Levels { int level_begin[]; };
layout(set = 0, binding = 2, std430) readonly buffer Squares { float squares[]; };  // of distances along u up to half a period, then along v
layout(set = 0, binding = 3, std430) writeonly buffer Limits { vec2 limits[]; };    // squared distance, squared rise; from first_row on

const float room = 1.0f + 1.0f / 65536.0f;  // more than all roundings of an estimate together

ivec2 texel;
float apex;
float distance2, rise2;  // of what limits so far
float widest;            // no less than their quotient

// a b < c d, exactly; all normal and positive, and the two products nearly equal.
bool less_exactly(float a, float b, float c, float d) {
    uvec4 bits = floatBitsToUint(vec4(a, b, c, d));
    uvec4 digits = (bits & 0x7fffffu) | 0x800000u;
    uint left_high, left_low, right_high, right_low;
    umulExtended(digits.x, digits.y, left_high, left_low);
    umulExtended(digits.z, digits.w, right_high, right_low);
    int shift = int(bits.x >> 23) + int(bits.y >> 23) - int(bits.z >> 23) - int(bits.w >> 23);  // at most 2 either way
    for (; shift > 0; --shift) left_high = left_high << 1 | left_low >> 31, left_low <<= 1;
    for (; shift < 0; ++shift) right_high = right_high << 1 | right_low >> 31, right_low <<= 1;
    return left_high != right_high ? left_high < right_high : left_low < right_low;
}

// Whether a texel at whole distances (di, dj), at most half a period, limits more than what did so far.
void consider(int di, int dj, float height) {
    precise float rise = height - apex;
    if (rise <= 0.0f) return;
    precise float r2 = rise * rise;
    precise float d2 = squares[di] + squares[now.width / 2 + 1 + dj];
    if (d2 >= r2) return;  // cones are no wider than 1
    float ours = d2 * rise2, theirs = distance2 * r2;
    if (ours > theirs * room) return;
    if (ours * room > theirs && !less_exactly(d2, rise2, distance2, r2)) return;
    distance2 = d2;
    rise2 = r2;
    widest = d2 / r2 * room;
}

// From `from` to the nearest of `count` places from `first` on, on a circle of `size`.
int gap(int from, int first, int count, int size) {
    int at = from - first;
    if (at < 0) at += size;
    return at < count ? 0 : min(at - count + 1, size - at);
}

int gap_x(int i, int level) { return gap(texel.x, i << level, min(now.width - (i << level), 1 << level), now.width); }
int gap_y(int j, int level) { return gap(texel.y, j << level, min(now.height - (j << level), 1 << level), now.height); }

int nodes_across(int level) { return (now.width + (1 << level) - 1) >> level; }
int nodes_down(int level) { return (now.height + (1 << level) - 1) >> level; }

bool may_limit(int i, int j, int level, int across, int down) {
    float rise = maxima[level_begin[level] + j * nodes_across(level) + i] - apex;
    return rise > 0.0f && squares[across] + squares[now.width / 2 + 1 + down] < widest * rise * rise;
}

void main() {
    texel = ivec2(int(gl_GlobalInvocationID.x), now.first_row + int(gl_GlobalInvocationID.y));
    if (texel.x >= now.width || texel.y >= now.height) return;
    apex = maxima[texel.y * now.width + texel.x];
    distance2 = rise2 = 1.0f;
    widest = room;

    // What limits a texel of a rough field is mostly beside it; having that first closes most nodes.
    for (int b = -2; b <= 2; ++b)
        for (int a = -2; a <= 2; ++a) {
            ivec2 at = ((texel + ivec2(a, b)) % ivec2(now.width, now.height) + ivec2(now.width, now.height)) % ivec2(now.width, now.height);
            consider(gap_x(at.x, 0), gap_y(at.y, 0), maxima[at.y * now.width + at.x]);
        }

    uint open[48];  // three a level and one; a node as its level and its place, 4, 14 and 14 bits
    int count = 0;
    open[count++] = uint(now.levels - 1) << 28;
    while (count > 0) {
        uint node = open[--count];
        int level = int(node >> 28), i = int(node >> 14 & 0x3fffu), j = int(node & 0x3fffu);
        if (!may_limit(i, j, level, gap_x(i, level), gap_y(j, level))) continue;
        if (level == 0) {
            consider(gap_x(i, 0), gap_y(j, 0), maxima[j * now.width + i]);
            continue;
        }
        // Nearest child last, so that it is taken first.
        --level;
        ivec2 last = ivec2(nodes_across(level), nodes_down(level)) - 1;
        ivec2 across, down;
        for (int k = 0; k < 2; ++k) {
            across[k] = gap_x(min(2 * i + k, last.x), level);
            down[k] = gap_y(min(2 * j + k, last.y), level);
        }
        int near_x = across[1] < across[0] ? 1 : 0, near_y = down[1] < down[0] ? 1 : 0;
        for (int k = 3; k >= 0; --k) {
            int half_x = near_x ^ (k & 1), half_y = near_y ^ (k >> 1);
            ivec2 child = ivec2(2 * i + half_x, 2 * j + half_y);
            if (child.x <= last.x && child.y <= last.y && may_limit(child.x, child.y, level, across[half_x], down[half_y]))
                open[count++] = uint(level) << 28 | uint(child.x) << 14 | uint(child.y);
        }
    }
    limits[(texel.y - now.first_row) * now.width + texel.x] = vec2(distance2, rise2);
}
