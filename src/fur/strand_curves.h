// Strands as curves: what layers of fur stand for, written down once more, for the reference.
#pragma once

#include "core/mesh.h"
#include "fur/coat.h"
#include "fur/roots.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relievo {

struct StrandCurves {
    int pieces = 0;               // straight ones, of each strand
    std::vector<Vec3f> points;    // pieces + 1 a strand, from root to tip
    std::vector<float> radii;     // at the points
    struct Strand {
        Vec3f normal;             // unit, of the skin at the root
        float tip = 1;            // its length, as a share of the coat's
        float sway = 0;           // x of its lock's sway at the tip, by which colours differ from lock to lock
        std::uint32_t chance = 0; // strand_chance of the root
    };
    std::vector<Strand> strands;
};

// What sets places of the skin apart beside the comb, a value for each vertex.
struct SkinValues {
    std::span<const float> lengths{};  // shares of the coat's length, in [0,1]; empty: 1 everywhere
    std::span<const Vec3f> pushes{};   // by how much more forces make tips lean (fur/fur_motion.h), radians; empty: not at all
};

// The strands that grow from the roots; docs/concepts/fur.md has the formulas. In double, from the same numbers as the programs that draw
// layers but not from their text. The mesh has unit normals and `comb` a vector per vertex; `spacing` is the mean distance of roots. Does
// not depend on `threads`.
StrandCurves strand_curves(const Mesh& mesh, const std::vector<Vec3f>& comb, const Roots& roots, const Coat& coat, double spacing, int pieces = 8, int threads = 0,
                           const SkinValues& skin = {});

}  // namespace relievo
