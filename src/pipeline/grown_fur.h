// What grows on a mesh before anything is drawn or written: the mesh in fur space, its strands' roots, how long they are.
#pragma once

#include "core/mesh.h"
#include "fur/coat.h"
#include "fur/fur_motion.h"
#include "fur/length_rules.h"
#include "fur/roots.h"
#include "fur/strand_curves.h"
#include "mesh/bounds.h"

namespace relievo {

struct GrownFur {
    Mesh mesh;            // in fur space; without normals of its own where no rule asked for them
    Sphere sphere;        // of the mesh in its file, which became the unit sphere
    Roots roots;          // of strands: where the skin is bare there are none
    std::vector<float> lengths;  // of the vertices, shares of the coat's length; empty: 1 everywhere
    std::size_t bare = 0; // roots that were left out for that
    float spacing = 0;    // mean distance between roots
    double roots_ms = 0;  // that they took
};

// Throws Error for meshes on which nothing can grow, and for rules that leave all of it bare.
GrownFur grown_fur(Mesh mesh, const Coat& coat, std::span<const LengthRule> rules, int threads = 0);

// Reads the masks that rules name. Throws Error.
std::vector<LengthRule> with_masks(std::vector<LengthRule> rules);

// Of strands as curves to be traced: so many straight pieces lie within a tenth of a pixel of their curve in pictures of 1280x800.
inline constexpr int reference_pieces = 8;

// Which way the fur lies at each vertex of its mesh. Gives that its normals.
std::vector<Vec3f> comb_of(GrownFur& fur, const Coat& coat, int threads = 0);

// The strands of the fur as curves of so many straight pieces, as the forces hold them. Gives the mesh its normals.
StrandCurves curves_of(GrownFur& fur, const Coat& coat, int pieces, const FurForces& forces = {}, int threads = 0);

}  // namespace relievo
