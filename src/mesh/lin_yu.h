// The K-cache reordering of Lin and Yu (2006), "An Improved Vertex Caching Scheme for 3D Mesh Rendering", in near-linear time.
#pragma once

#include <cstdint>
#include <vector>

namespace relievo {

// The cost of drawing all remaining faces of a cached vertex next; the vertex of least cost is taken. The first three terms are the
// paper's k1 C1 + k2 C2 + k3 C3, with its k1 = 1 as the unit; the others are ours. docs/concepts/meshes.md shows what each is worth.
struct LinYuWeights {
    float faces = -0.7f;       // k2, per face drawn: negative, as drawing many faces for few vertices is the aim
    float freshness = 1.28f;   // k3, times how far the vertex will be from leaving the cache: old vertices first
    float evicted = 0.15f;     // per vertex that leaves the cache with faces left, and will have to come back
    float opened = 0.1f;       // per face left at the vertices that enter: an open front is a promise to be kept
    float undecided = 0.15f;   // two vertices whose costs differ by less are both tried one step further; 0 never looks ahead
};

// The weights that a search over the bunny, the armadillo and a reduced dragon found best for caches near 16 and near 32 vertices.
LinYuWeights lin_yu_weights(int cache);

// The faces of `indices` (three each, below `vertices`) in an order for a FIFO cache of `cache` vertices (4 to 255), each possibly
// rotated, none turned over. O(faces x valence + vertices x cache). Not thread dependent.
std::vector<std::uint32_t> lin_yu_order(std::vector<std::uint32_t> indices, std::uint32_t vertices, int cache, const LinYuWeights& weights);

}  // namespace relievo
