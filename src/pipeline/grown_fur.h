// What grows on a mesh before anything is drawn or written: the mesh in fur space, its strands' roots, how long they are.
#pragma once

#include "core/mesh.h"
#include "fur/coat.h"
#include "fur/fur_motion.h"
#include "fur/length_rules.h"
#include "fur/painted_comb.h"
#include "fur/roots.h"
#include "fur/strand_curves.h"
#include "mesh/bounds.h"

namespace relievo {

struct GrownFur {
    Mesh mesh;            // in fur space; without normals of its own where no rule asked for them
    Sphere sphere;        // of the mesh in its file, which became the unit sphere
    Roots roots;          // of strands: where the skin is bare there are none
    std::vector<float> lengths;  // of the vertices, shares of the coat's length; empty: 1 everywhere
    std::vector<PaintedLean> painted;  // of the vertices, the comb that a user painted; empty: none
    bool upright = false;              // beside it
    std::size_t bare = 0; // roots that were left out for that
    float spacing = 0;    // mean distance between roots
    double roots_ms = 0;  // that they took
};

// What is asked of a place before a coat grows there; pictures have been read.
struct Growth {
    std::vector<LengthRule> lengths;  // where fur is shorter
    CombPaint comb;                   // which way it lies
    bool upright = false;             // where nothing is painted it stands up, as in mode classic
};

// Throws Error for meshes on which nothing can grow, for rules that leave all of it bare, and for paint that does not fit the mesh.
GrownFur grown_fur(Mesh mesh, const Coat& coat, const Growth& growth, int threads = 0);

// A mesh in fur space, and the comb that a user painted on its vertices; none: nothing is painted.
struct PaintedSkin {
    Mesh mesh;
    std::vector<PaintedLean> painted;
};

// What the paint says on the mesh, which gets its normals where it has none, and a note where that is nothing. Throws Error.
std::vector<PaintedLean> painted_on(Mesh& mesh, const CombPaint& comb, int threads = 0);

// Reads the pictures that it names. Throws Error.
Growth with_pictures(Growth growth);

// Of strands as curves to be traced: so many straight pieces lie within a tenth of a pixel of their curve in pictures of 1280x800.
inline constexpr int reference_pieces = 8;

// Which way the fur lies at each vertex of its mesh. Gives that its normals.
std::vector<Vec3f> comb_of(GrownFur& fur, const Coat& coat, int threads = 0);

// The strands of the fur as curves of so many straight pieces, as the forces hold them. Gives the mesh its normals.
StrandCurves curves_of(GrownFur& fur, const Coat& coat, int pieces, const FurForces& forces = {}, int threads = 0);

}  // namespace relievo
