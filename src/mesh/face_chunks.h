// A mesh cut into compact pieces that several threads can work on.
#pragma once

#include "core/mesh.h"

#include <cstdint>
#include <vector>

namespace relievo {

struct FaceChunks {
    std::vector<std::uint32_t> faces;  // all faces of the mesh, chunk after chunk
    std::vector<std::uint32_t> begin;  // where each chunk begins in `faces`, and after the last one faces.size()
    std::size_t count() const { return begin.size() - 1; }
};

// Halves the mesh by a plane across an axis, and the halves again, as long as each part keeps at least `least_faces` (at least 1).
// A cut lies near the middle where the surface is thin, because work done in chunks is lost along the cuts. A mesh of fewer than
// twice as many faces is one chunk. Within a chunk of a mesh of 50,000 faces or more, neighbours in space lie near each other in the
// list, which makes whatever walks over the surface faster. Depends on the mesh alone, never on `threads`.
FaceChunks face_chunks(const Mesh& mesh, std::uint32_t least_faces, int threads = 0);

}  // namespace relievo
