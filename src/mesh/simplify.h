// Coarser meshes by edge collapse under quadrics (Garland and Heckbert 1997), done by meshoptimizer, and how far they are off.
#pragma once

#include "core/mesh.h"

#include <cstddef>
#include <vector>

namespace relievo {

struct SimplifyTarget {
    std::size_t faces = 0;  // stop at so many; 0: no count, stop at the error
    double error = 0;       // largest deviation, in shares of the mesh's largest extent, as the quadrics estimate it; 0: no limit
    bool fast = false;      // with `faces`: meshes of many more are first cut down to five times as many by joining what lies in one cell of
                            // a grid (Rossignac and Borrel 1993), which may also join what only lies near
};

struct SimplifiedMesh {
    Mesh mesh;                  // of the vertices still used
    double estimated_error = 0; // by the quadrics, in the mesh's units
};

// At least one of the target's fields is set. The border of open meshes may move where it must. Where edge collapse alone stops
// above the count (it never changes how a surface hangs together), vertices at one position are first made one, so that seams no
// longer hold it up. A count within 1 % is reached on connected meshes; where it is not, the result is the coarsest reached.
SimplifiedMesh simplified(const Mesh& mesh, const SimplifyTarget& target, int threads = 0);

}  // namespace relievo
