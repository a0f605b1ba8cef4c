// A cell's largest corner, rounded up to one of 256 levels.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "cell_cone.glsl"

layout(set = 0, binding = 0, std430) readonly buffer Heights { uint heights[]; };  // floats in [0,1], as their bits
layout(set = 0, binding = 1, std430) readonly buffer Levels { uint levels[]; };    // 256 rising floats from 0 to 1, as their bits
layout(set = 0, binding = 2, std430) writeonly buffer Cells { uint cells[]; };

uint height(int x, int y) { return heights[y * now.width + x] & 0x7fffffffu; }  // -0 is 0

void main() {
    ivec2 at = own_cell();
    if (at.x >= now.width) return;
    int x1 = wrapped(at.x + 1, now.width);
    int y1 = wrapped(at.y + 1, now.height);
    // Floats that are not negative are ordered as their bits.
    uint highest = max(max(height(at.x, at.y), height(x1, at.y)), max(height(at.x, y1), height(x1, y1)));
    // However the product is rounded, its whole part is at most one above the level looked for.
    int level = max(int(uintBitsToFloat(highest) * 255.0f) - 1, 0);
    while (levels[level] < highest) ++level;
    cells[at.y * now.width + at.x] = uint(level);
}
