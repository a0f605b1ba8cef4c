// Strands as programs that plot them receive them: where each stands, how the skin and the comb lie there, and a number of its own.
#pragma once

#include "core/mesh.h"
#include "fur/roots.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace relievo {

struct RootedStrands {
    struct Place {
        Vec3f root;
        std::uint32_t comb = 0;    // x, y, z in 10 bits each from [-1,1], x lowest
    };
    struct Nature {
        std::uint32_t normal = 0;  // unit, octahedral in 16 + 16 signed bits (Meyer et al. 2010, "On Floating-Point Normal Vectors"), x lower
        std::uint32_t own = 0;     // strand_chance of the root in the lower 16 bits, length as a share of the coat's in the upper
    };
    std::vector<Place> places;
    std::vector<Nature> natures;
};

// One strand a root, in their order: neighbours in it are neighbours on the skin, so that what is plotted together lies near each other in the picture, and multiples
// of an irrational number spread evenly over the skin. The mesh has unit normals, `comb` a vector per vertex and `lengths` a share in [0,1] (empty: 1 everywhere);
// between vertices they are interpolated. Does not depend on `threads`.
RootedStrands rooted_strands(const Mesh& mesh, const std::vector<Vec3f>& comb, const std::vector<float>& lengths, const Roots& roots, int threads = 0);

// What the vertices have, where each strand stands; a fourth number of 0 makes texels of them.
std::vector<std::array<float, 4>> at_strands(const Mesh& mesh, const Roots& roots, std::span<const Vec3f> of_vertices, int threads = 0);

}  // namespace relievo
