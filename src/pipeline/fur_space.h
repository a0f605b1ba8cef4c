// A mesh where fur is grown: its smallest sphere is the unit sphere around the origin.
#pragma once

#include "core/mesh.h"
#include "mesh/bounds.h"

namespace relievo {

// The mesh moved and scaled so, without the points that no face uses, which would count as part of its size. Throws Error for meshes
// without faces and for those whose points are all one.
Mesh in_fur_space(Mesh mesh, int threads = 0);

// The same, with the sphere that became the unit sphere: what leads back to the file's own space.
struct FurSpace {
    Mesh mesh;
    Sphere sphere;
};
FurSpace moved_into_fur_space(Mesh mesh, int threads = 0);

}  // namespace relievo
