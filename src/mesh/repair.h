// Mending what can be mended without guessing at the surface.
#pragma once

#include "core/mesh.h"

#include <cstddef>

namespace relievo {

struct Repair {
    std::size_t faces_collapsed = 0;       // taken out: two corners at one place
    std::size_t faces_repeated = 0;        // taken out: the same three positions as an earlier face
    std::size_t faces_turned = 0;          // turned over to agree with their neighbours
    std::size_t pieces_turned_out = 0;     // closed pieces that were inside out as a whole
    std::size_t vertices_merged = 0;       // equal to an earlier one
    std::size_t vertices_unreferenced = 0; // taken out
};

struct RepairedMesh {
    Mesh mesh;  // its notes say what was done
    Repair changed;
};

// Takes out collapsed and repeated faces, turns faces over until neighbours agree (in each piece the side of the majority by
// area stays), turns closed pieces with negative volume inside out, merges equal vertices and drops unused ones. Holes and
// edges of three faces stay as they are, as closing or cutting them would be a guess; so do faces whose three corners lie on a line,
// because without them there would be a slit. Normals of turned faces' vertices are left to
// continuous_normals. Does not depend on `threads`.
RepairedMesh repaired(Mesh mesh, int threads = 0);

}  // namespace relievo
