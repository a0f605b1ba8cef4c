// What is known at the vertices of a mesh, on the way through what changes the mesh.
#pragma once

#include "core/mesh.h"
#include "fur/painted_comb.h"

#include <span>
#include <vector>

namespace relievo {

struct SkinPaint {
    std::vector<float> lengths;        // shares of the coat's length; empty: 1 everywhere
    std::vector<PaintedLean> painted;  // empty: nothing
};

// Simplification, refinement and indexing keep texture coordinates and colours, and the values travel as those: the mesh's own are lost. Without values
// it is the mesh unchanged.
Mesh carrying(const Mesh& mesh, std::span<const float> lengths, std::span<const PaintedLean> painted);

// Takes the values off again, of the same kinds as were put on.
SkinPaint taken_off(Mesh& mesh, bool lengths, bool painted);

}  // namespace relievo
