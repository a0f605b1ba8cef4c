// What grows on a mesh before anything is drawn or written: the mesh in fur space, its strands' roots, how long they are.
#pragma once

#include "core/mesh.h"
#include "fur/coat.h"
#include "fur/roots.h"
#include "fur/strand_curves.h"
#include "mesh/bounds.h"

namespace relievo {

struct GrownFur {
    Mesh mesh;            // in fur space; without normals of its own
    Sphere sphere;        // of the mesh in its file, which became the unit sphere
    Roots roots;
    float spacing = 0;    // mean distance between roots
    double roots_ms = 0;  // that they took
};

// Throws Error for meshes on which nothing can grow.
GrownFur grown_fur(Mesh mesh, const Coat& coat, int threads = 0);

// The strands of the fur as curves of so many straight pieces. Gives the mesh its normals.
StrandCurves curves_of(GrownFur& fur, const Coat& coat, int pieces, int threads = 0);

}  // namespace relievo
