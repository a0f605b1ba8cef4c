// Darts thrown at every face of a mesh in proportion to its area, in packs that threads throw on their own.
#pragma once

#include "fur/dart_grid.h"
#include "fur/roots.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relievo {

// A pack of darts, block by block of the grid.
struct DartPack {
    std::vector<Root> darts;
    std::vector<std::uint64_t> blocks;
    std::vector<std::uint32_t> begin;  // of each block's darts, and the end of the last's

    std::span<const Root> of(std::uint32_t block) const { return {darts.data() + begin[block], darts.data() + begin[block + 1]}; }
};

// So many darts as each face may expect, rounded up as often as the fraction says. Random numbers come from the corners' positions, so that darts are those of the surface: the
// same for any `threads` and for faces in any order, but for the order in which they come.
std::vector<DartPack> throw_darts(const Mesh& mesh, std::span<const float> expected, const DartGrid& grid, std::uint32_t seed, int threads = 0);

}  // namespace relievo
