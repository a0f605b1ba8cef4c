// Where strands grow: a Poisson-disk sample of a surface, even by area, no two roots nearer than a distance.
#pragma once

#include "core/mesh.h"

#include <cstdint>
#include <vector>

namespace relievo {

struct RootSettings {
    std::uint32_t count = 200000;  // wanted, at least 1; on a smooth closed surface within 3 % of it come, a few more at borders
    std::uint32_t seed = 1;
    int threads = 0;
};

struct Root {
    Vec3f position;  // on the face, in the mesh's space
    std::uint32_t face = 0;
};

struct Roots {
    std::vector<Root> roots;  // along a curve that fills space (Morton 1966): neighbours in the list are near each other
    double distance = 0;      // no two of them on faces that look the same way are nearer, in the mesh's units
    double area = 0;          // of the surface
};

// Darts thrown at every face in proportion to its area, kept where no kept one is near (Cook 1986, "Stochastic Sampling in Computer
// Graphics"; on surfaces Cline et al. 2009, "Dart Throwing on Surfaces"). Distances are straight lines in space, but only between
// darts whose faces look the same way (a positive product of normals): the two sides of an ear do not thin each other out. Faces that
// repeat an earlier one grow nothing, as their darts fall on the same places. Blocks of space are worked on in eight groups of which no
// two blocks touch (Wei 2008, "Parallel Poisson Disk Sampling"), each by one thread.
// Random numbers come from the corners' positions, so that the roots are those of the surface: the same for any `threads` and for
// faces in any order. Throws Error for a mesh without area.
Roots grow_roots(const Mesh& mesh, const RootSettings& settings = {});

// Of the corners of its face, in their order; not negative, of sum 1.
Vec3f corner_weights(const Mesh& mesh, const Root& root);

}  // namespace relievo
