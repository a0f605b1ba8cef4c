// An order of faces for a cache of vertices that no particular machine has: Forsyth (2006), "Linear-Speed Vertex Cache Optimisation",
// which is also the way of meshoptimizer's default.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace relievo {

// The faces of `indices` (three each, below `vertices`), each as it was, drawn one after the other by the score of their vertices: high
// for those used lately and for those with few faces left. O(faces x valence). Not thread dependent.
std::vector<std::uint32_t> scored_order(std::span<const std::uint32_t> indices, std::uint32_t vertices);

}  // namespace relievo
