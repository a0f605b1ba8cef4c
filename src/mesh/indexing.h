// Duplicate detection: vertices that say the same become one, and those that no face uses go.
#pragma once

#include "core/mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relievo {

// The mesh with every vertex once, in the order of their first appearance, and only those that faces use. Faces keep their order.
// The result does not depend on `threads`.
Mesh indexed(Mesh mesh, int threads = 0);

// The same where `first` is known: for each vertex the first one equal to it, from first_equal_vertex. Where all other attributes follow
// from the position, as continuous normals do, that of positions says as much as that of everything.
Mesh indexed(Mesh mesh, const std::vector<std::uint32_t>& first, int threads = 0);

// Bytes of one vertex: 12 for the position, 12 more for a normal, 8 for texture coordinates, 12 for a colour.
std::size_t vertex_bytes(const Mesh& mesh);

// Bytes of one index: 2 below 65,536 vertices, else 4.
std::size_t index_bytes(std::size_t vertices);

// The mesh drawn as a list: three whole vertices a face and no indices.
std::size_t list_bytes(const Mesh& mesh);

// The mesh drawn through its indices: each vertex once, and the indices.
std::size_t indexed_bytes(const Mesh& mesh);

}  // namespace relievo
