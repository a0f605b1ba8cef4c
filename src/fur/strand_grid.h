// Roots as a program finds those near a point: one look into a hash table of cells gives a list of all that may be near.
#pragma once

#include "core/mesh.h"
#include "fur/roots.h"

#include <array>
#include <cstdint>
#include <vector>

namespace relievo {

// A root as the list of a cell has it, as it is read over and over: two words instead of the five of a number and a place.
//   first   position from the cell's low corner, three times 10 bits, x lowest; 0 is one cell below the corner, 1023 two above it
//   second  normal in 8 + 8 bits (octahedral: Meyer et al. 2010, "On Floating-Point Normal Vectors"), 16 bits of chance of its own
using ListedRoot = std::array<std::uint32_t, 2>;

// Cells in bricks of 8 x 8 x 8: a dense table tells each brick's number, and only bricks near the surface have one of their own.
struct StrandGrid {
    Vec3f low;                          // corner of the table
    float cells_per_unit = 1;
    std::array<int, 3> size{};          // of the table, in bricks
    std::vector<std::uint32_t> bricks;  // x first; 0 is the brick without roots
    std::vector<std::uint32_t> starts;  // of each cell's list, 512 for each brick, x first; and the end of the last
    std::vector<ListedRoot> lists;
    float reach = 0, off = 0;
};

// A point of a cell finds in its list every root that is within `reach` of it along the root's tangent plane and within `off` of it across,
// `off` being how far points may lie off the surface. Does not depend on `threads`.
struct GridSettings {
    float reach = 0;  // positive
    float off = 0;    // not negative
    int threads = 0;
};
StrandGrid strand_grid(const Mesh& mesh, const Roots& roots, const GridSettings& settings);

std::uint32_t packed_normal(Vec3d direction);  // the lower 16 bits of the second word
std::uint32_t strand_chance(Vec3f root);       // 16 bits that depend on nothing but the place

}  // namespace relievo
