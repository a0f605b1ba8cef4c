// What a mesh is as a surface: closed or not, in one piece or many, and what is wrong with it. Vertices at one position count as one
// here, however many a file keeps for the sake of normals or seams.
#pragma once

#include "core/mesh.h"

#include <cstddef>
#include <optional>

namespace relievo {

struct Topology {
    std::size_t vertices = 0;               // in the mesh
    std::size_t distinct_positions = 0;     // among the vertices that faces use
    std::size_t duplicate_vertices = 0;     // equal in everything to an earlier one
    std::size_t unreferenced_vertices = 0;  // no face uses them
    std::size_t faces = 0;
    std::size_t degenerate_faces = 0;       // two corners at one place, or no area: left out of everything below when the former
    std::size_t duplicate_faces = 0;        // the same three positions as an earlier face, in any order
    std::size_t edges = 0;
    std::size_t boundary_edges = 0;         // one face
    std::size_t non_manifold_edges = 0;     // three faces or more
    std::size_t non_manifold_vertices = 0;  // the faces around them do not form one fan: two cones tip to tip
    std::size_t flipped_edges = 0;          // two faces that run along it the same way: one of them is inside out
    std::size_t holes = 0;                  // closed loops of boundary edges, or other chains of them
    std::size_t components = 0;             // pieces connected across edges
    bool closed = false;                    // every edge has two faces
    bool oriented = false;                  // no flipped edge
    std::optional<long> euler;              // vertices - edges + faces; none without faces
    // Handles, summed over components, of a mesh whose edges and vertices are manifold and whose faces agree; (2 C - holes - euler) / 2.
    std::optional<long> genus;
};

// Linear in time but for sorting the edges. The result does not depend on `threads`.
Topology topology(const Mesh& mesh, int threads = 0);

}  // namespace relievo
