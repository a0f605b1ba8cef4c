// The map's texels, a band of its rows at a time: toward smaller i and j, a cell's square is the one that begins where its own ends.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "cell_cone.glsl"

layout(set = 0, binding = 0, std430) readonly buffer Cells { uint cells[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Texels { uint texels[]; };  // from first_row on

uint roof(ivec2 cell, ivec2 back, uint channel) {
    int x = wrapped(cell.x + back.x, now.width);
    int y = wrapped(cell.y + back.y, now.height);
    return cells[y * now.width + x] & channel;
}

void main() {
    ivec2 at = own_cell();  // its row is the map's
    if (at.x >= now.width) return;
    int quadrant = at.y / now.height;
    ivec2 cell = ivec2(at.x, at.y - quadrant * now.height);
    ivec2 towards = ivec2(quadrant & 1, quadrant >> 1);
    texels[(at.y - now.first_row) * now.width + at.x] =
        roof(cell, ivec2(0, 0), 0xffu) | roof(cell, towards * ivec2(now.back_near_x, now.back_near_y), 0xff00u) |
        roof(cell, towards * ivec2(now.back_middle_x, now.back_middle_y), 0xff0000u) |
        roof(cell, towards * ivec2(now.back_far_x, now.back_far_y), 0xff000000u);
}
