// Cells of a field that repeats, one word each: the largest corner in bits 0 to 7, then the roofs of the three squares that begin at
// the cell, eight bits each. All numbers are whole, and heights are compared by their bits: no device rounds, flushes or fuses anything.
#include "../../shared/cell_cone_bake.h"

layout(local_size_x = 64) in;
layout(push_constant) uniform Step { CellConeStep now; };

// at is not negative.
int wrapped(int at, int size) {
    while (at >= size) at -= size;
    return at;
}

// The cell of this invocation; x may lie behind the row's end, and then there is nothing to do.
ivec2 own_cell() { return ivec2(int(gl_GlobalInvocationID.x), now.first_row + int(gl_WorkGroupID.y)); }
