// What the vector kernels read: heights and the pyramid of cell maxima, laid out for gathers.
#pragma once

#include "cast/height_field_caster.h"

#include <cstddef>
#include <cstdint>

namespace relievo {

struct CastGrid {
    int width = 0;  // texels of one period, as many cells
    int height = 0;
    // The bilinear patches of 4x4 cells side by side, block after block, rows of blocks (the last of a row or column may hang
    // over): 16 heights of the corner with the least x and y, 16 slopes along x there, 16 along y, 16 twists; cells of a block row
    // by row.
    const float* patches = nullptr;
    const std::uint16_t* tops = nullptr;  // the 16 cells' largest corners, as nodes
    int block_columns = 0;
    // All levels of the pyramid one above the other with one pitch, so that a node's place is arithmetic, not a table: row of node
    // row r of level l is r + stack - (stack >> l), where stack is twice the rows of level 0 rounded up to whole nodes of the top.
    // 16 bits, rounded up: a node of value q is no higher than q * node_unit.
    const std::uint16_t* nodes = nullptr;
    int node_pitch = 0;
    int stack = 0;
    int levels = 0;
};

inline constexpr int block_side = 4;
inline constexpr int block_level = 2;  // of the pyramid: its nodes are the blocks' maxima
inline constexpr int block_cells = block_side * block_side;
// Where the parts of a block's patches begin.
inline constexpr int patch_height = 0, patch_slope_x = 16, patch_slope_y = 32, patch_twist = 48, patch_floats = 64;

inline constexpr float node_unit = 1.0f / 65535;

using CastFunction = void (*)(const CastGrid&, const CastRay* rays, std::size_t count, CastHit* hits);

struct CastTarget {
    const char* name;
    CastFunction function;
};

// The compiled kernels that this processor runs, best first.
std::vector<CastTarget> runnable_cast_targets();

}  // namespace relievo
