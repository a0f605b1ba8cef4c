// Finer layers for coarse meshes: between the corners of a large face, fur would lie as at the corners.
#pragma once

#include "core/mesh.h"

#include <cstddef>

namespace relievo {

// The mesh with every face cut into four at the middles of its sides, again and again as long as no more than `most` faces come of it. Middles have
// the mean normal of their ends, of unit length (that of one end where the mean is nothing), and lie on the straight side: the surface
// stays what it was; texture coordinates go along, colours do not. Faces that share a side go on sharing it.
Mesh refined(Mesh mesh, std::size_t most);

}  // namespace relievo
