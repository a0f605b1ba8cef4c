// The roof of the square that begins at a cell, from the roofs of smaller squares: as many as cover it, the last one moved back to its end.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "cell_cone.glsl"

layout(set = 0, binding = 0, std430) readonly buffer Before { uint before[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Cells { uint cells[]; };

void main() {
    ivec2 at = own_cell();
    if (at.x >= now.width) return;
    int last = now.covered - now.have;
    uint highest = 0u;
    for (int b = 0; b < last + now.have; b += now.have) {
        int row = wrapped(at.y + min(b, last), now.height) * now.width;
        for (int a = 0; a < last + now.have; a += now.have)
            highest = max(highest, before[row + wrapped(at.x + min(a, last), now.width)] >> (now.bits - 8) & 255u);
    }
    int own = at.y * now.width + at.x;
    cells[own] = before[own] | highest << now.bits;
}
