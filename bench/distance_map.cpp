// Time of the 3D distance map of 512 x 512 x 64 voxels on five materials, against the plain way: for every voxel a scan of the texels'
// columns in growing rings that stops once a ring is too far away to matter (against_rings.h), which is checked to be nowhere below
// ours.
#include "against_rings.h"
#include "maps/distance_map.h"
#include "textures/procedural.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace relievo;
using namespace relievo::bench;

constexpr float height_scale = 0.1f;

// The distance of the voxel in column x of `row`, rows of all slices one after the other, by rings of columns.
float ring_distance(const HeightField& field, int x, int row) {
    const int w = field.width();
    const int h = field.height();
    const float a = 1 / (height_scale * static_cast<float>(w));
    const float b = 1 / (height_scale * static_cast<float>(h));
    const float z = static_cast<float>(row / h) / static_cast<float>(distance_slices - 1);
    const int y = row % h;
    float best = 1e30f;
    const auto visit = [&](int i, int j) {
        const float down = std::max(0.0f, z - field.texels(wrap_index(x + i, w), wrap_index(y + j, h)));
        const float across = static_cast<float>(i) * a;
        const float along = static_cast<float>(j) * b;
        best = std::min(best, across * across + along * along + down * down);
    };
    visit(0, 0);
    for (int r = 1; r <= std::min(w, h) / 2; ++r) {
        const float nearest = static_cast<float>(r) * std::min(a, b);
        if (nearest * nearest >= best) break;
        for (int d = -r; d <= r; ++d) visit(d, -r), visit(d, r);
        for (int d = 1 - r; d < r; ++d) visit(-r, d), visit(r, d);
    }
    return std::sqrt(best);
}

void distance(benchmark::State& state, const char* id) {
    const HeightField field = procedural_material(id, 512, 1, 0).height;
    ImageF result;
    ImageF expected(field.width(), field.height() * distance_slices, 1);
    against_rings(
        state, "distance", id, expected.height, [&] { result = distance_map(field, height_scale); },
        [&](int row) {
            for (int x = 0; x < field.width(); ++x) expected(x, row) = ring_distance(field, x, row);
        },
        [&](int row) {
            for (int x = 0; x < field.width(); ++x)
                if (result(x, row) > expected(x, row)) return false;
            return true;
        });
}

#define MATERIAL(name) BENCHMARK_CAPTURE(distance, name##_512, #name)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(5)
MATERIAL(bricks);
MATERIAL(cobbles);
MATERIAL(spikes);
MATERIAL(dunes);
MATERIAL(engraving);
BENCHMARK_CAPTURE(mean_of_ratios, all, "distance")->Iterations(1);

}  // namespace
