// Cellular texture: distances to the nearest of scattered points, on a periodic lattice with one point per cell.
//
// Worley, "A cellular texture basis function", SIGGRAPH 1996. One point per cell with a jitter of at most one half around its
// centre keeps the nearest point within the 3 x 3 neighbourhood.
#pragma once

#include "core/vec.h"

#include <cstdint>

namespace relievo {

struct CellularSpec {
    int cells_u = 8;
    int cells_v = 8;
    float jitter = 0.45f;  // half the range of a point around its cell's centre, in cells, at most 0.5
    std::uint32_t seed = 0;
};

struct Cellular {
    float nearest;     // F1, in cells
    float second;      // F2, in cells
    Vec2f offset;      // from the nearest point to the place asked for, in cells
    std::uint32_t id;  // hash that belongs to the nearest point
};

Cellular cellular(Vec2f uv, const CellularSpec& spec);

}  // namespace relievo
