// Exact first hits and shadows of a relief on an unwrapped mesh: on flat charts of the relief itself, on bent ones of the relief over
// the tangent plane of each pixel, which is the question that techniques are asked there.
#pragma once

#include "core/frame.h"
#include "core/height_field.h"
#include "core/lighting.h"
#include "core/mesh_rays.h"
#include "core/vec.h"

#include <functional>

namespace relievo {

struct MeshHitSettings {
    double zero_level = 1;
    bool shadow = true;  // hard, of the key light (the first), by the relief on itself
    // The share of a way in UV that stays on a pixel's chart, after a first way over it; empty: all of it.
    std::function<double(int x, int y, Vec2d first, Vec2d way)> on_chart = {};
    int threads = 0;
};

// Coverage, hit UV and height, and shadow; the other planes stay 0. A ray whose range of heights meets nothing is no_hit.
Frame reference_mesh_hits(const MeshRays& rays, const HeightField& field, const Lighting& lighting, const MeshHitSettings& settings);

}  // namespace relievo
