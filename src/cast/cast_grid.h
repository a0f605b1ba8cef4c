// What the vector kernels read: heights and the pyramid of cell maxima, laid out for gathers.
#pragma once

#include "cast/height_field_caster.h"

#include <cstddef>
#include <cstdint>

namespace relievo {

struct CastGrid {
    int width = 0;  // texels of one period, as many cells
    int height = 0;
    // Rows of pairs: a texel and the one above it; after the last pair of a row its first. So a cell's corners lie side by side
    // (h00, h01, h10, h11). patch_pitch floats a row.
    const float* patches = nullptr;
    int patch_pitch = 0;
    // The largest corners of 4x4 cells, as nodes, block after block, rows of blocks (the last of a row or column may hang over).
    const std::uint16_t* tops = nullptr;
    int block_columns = 0;
    // Of the blocks from each on along y (up) or x (right), roof_blocks of them: in the upper 16 bits the largest height, as nodes,
    // in the lower the mean height of their cells' tops, rounded.
    const std::uint32_t *roofs_up = nullptr, *roofs_right = nullptr;
    // The blocks' largest heights, rounded up as nodes: up, column after column; right, row after row. Lines are repeated for
    // another tops_slack blocks.
    const float *tops_up = nullptr, *tops_right = nullptr;
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
inline constexpr int roof_blocks = 4;
inline constexpr int tops_slack = 40;  // the rows of the widest bundle, and a vector
inline constexpr int block_cells = block_side * block_side;
inline constexpr int patch_step = 2;  // floats from a cell's patch to that of the next along x

inline constexpr float node_unit = 1.0f / 65535;

using CastFunction = void (*)(const CastGrid&, const CastRay* rays, std::size_t count, CastHit* hits);

struct CastTarget {
    const char* name;
    CastFunction function;
};

// The compiled kernels that this processor runs, best first.
std::vector<CastTarget> runnable_cast_targets();

}  // namespace relievo
