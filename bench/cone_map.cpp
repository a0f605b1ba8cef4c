// Time of the cone map on six kinds of field, against the plain way of finding the same bits: a scan in growing rings that
// stops once a ring is too far away to matter (against_rings.h).
#include "against_rings.h"
#include "maps/cone_map.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace relievo;
using namespace relievo::bench;

// The definition of maps/cone_map.h by rings of texels around a texel.
float ring_ratio(const HeightField& field, int x, int y, float highest) {
    const int w = field.width();
    const int h = field.height();
    const float shorter = 1.0f / static_cast<float>(std::max(w, h));
    const float apex = field.texels(x, y);
    float q = 1.0f;
    const auto visit = [&](int di, int dj) {
        const float rise = field.texels(wrap_index(x + di, w), wrap_index(y + dj, h)) - apex;
        if (rise <= 0) return;
        const float u = static_cast<float>(std::abs(di)) / static_cast<float>(w);
        const float v = static_cast<float>(std::abs(dj)) / static_cast<float>(h);
        q = std::min(q, (u * u + v * v) / (rise * rise));
    };
    const float most = highest - apex;
    for (int r = 1; r <= std::max(w, h) / 2 && most > 0; ++r) {
        const float nearest = static_cast<float>(r) * shorter;
        if (nearest * nearest * 0.99999f >= q * most * most) break;
        const int rx = std::min(r, w / 2);
        const int ry = std::min(r, h / 2);
        if (r <= h / 2)
            for (int d = -rx; d <= rx; ++d) {
                visit(d, -r);
                visit(d, r);
            }
        if (r <= w / 2)
            for (int d = 1 - ry; d < ry + (r > h / 2); ++d) {
                visit(-r, d);
                visit(r, d);
            }
    }
    return std::sqrt(q);
}

void cone(benchmark::State& state, float (*shape)(float, float, int), const std::string& name) {
    const HeightField field = make(shape, 1024);
    const float highest = *std::ranges::max_element(field.texels.texels);
    ImageF result;
    ImageF expected(field.width(), field.height(), 1);
    against_rings(
        state, "cone", name, field.height(), [&] { result = cone_map(field); },
        [&](int y) {
            for (int x = 0; x < field.width(); ++x) expected(x, y) = ring_ratio(field, x, y, highest);
        },
        [&](int y) {
            for (int x = 0; x < field.width(); ++x)
                if (result(x, y, 1) != expected(x, y)) return false;
            return true;
        });
}

#define FIELD(name) BENCHMARK_CAPTURE(cone, name##_1024, name, #name)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(5)
FIELD(fbm);
FIELD(cobbles);
FIELD(spikes);
FIELD(flat);
FIELD(steps);
FIELD(grooves);
BENCHMARK_CAPTURE(mean_of_ratios, all, "cone")->Iterations(1);

}  // namespace
