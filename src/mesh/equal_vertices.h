// Which vertices say the same: the question behind continuous normals, indexing and every count of the analysis.
#pragma once

#include "core/mesh.h"

#include <cstdint>
#include <vector>

namespace relievo {

enum class Compared {
    positions,   // vertices at the same place
    everything,  // the same place and equal normal, texture coordinate and colour, where the mesh has them
};

// For each vertex the lowest index of a vertex equal to it (its own where it is the first). Values are compared exactly, as numbers:
// 0 equals -0. Linear in time; the result does not depend on `threads` (0: all cores).
std::vector<std::uint32_t> first_equal_vertex(const Mesh& mesh, Compared compared, int threads = 0);

}  // namespace relievo
