// Time of the cone map on five kinds of field, against the plain way of finding the same bits: a scan in growing rings that
// stops once a ring is too far away to matter. Both use all cores and run in turn, A B A B; "ring_scan_over_ours" is the ratio of
// the medians of the run.
#include "fields.h"
#include "maps/cone_map.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace relievo;
using namespace relievo::bench;

// The definition of maps/cone_map.h by rings of texels around each texel.
ImageF ring_scan(const HeightField& field) {
    const int w = field.width();
    const int h = field.height();
    const float highest = *std::ranges::max_element(field.texels.texels);
    const float shorter = 1.0f / static_cast<float>(std::max(w, h));
    ImageF cones(w, h, 2);
    parallel_for(h, 4, 0, [&](int begin, int end) {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < w; ++x) {
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
                cones(x, y, 0) = apex;
                cones(x, y, 1) = std::sqrt(q);
            }
    });
    return cones;
}

void cone(benchmark::State& state, float (*shape)(float, float, int), int size, bool against_rings) {
    const HeightField field = make(shape, size);
    std::vector<double> ours;
    std::vector<double> rings;
    ImageF result;
    ImageF expected;
    for (auto _ : state) {
        ours.push_back(seconds_of([&] { result = cone_map(field); }));
        if (against_rings) rings.push_back(seconds_of([&] { expected = ring_scan(field); }));
        state.SetIterationTime(ours.back());
    }
    state.counters["ours_ms_median"] = 1e3 * median(ours);
    state.counters["ours_ms_min"] = 1e3 * *std::ranges::min_element(ours);
    if (!against_rings) return;
    state.counters["ring_scan_over_ours"] = median(rings) / median(ours);
    if (result.texels != expected.texels) state.SkipWithError("the two differ");
}

#define FIELD(name) \
    BENCHMARK_CAPTURE(cone, name##_1024, name, 1024, false)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(5); \
    BENCHMARK_CAPTURE(cone, name##_512_against_rings, name, 512, true)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(3)
FIELD(fbm);
FIELD(cobbles);
FIELD(spikes);
FIELD(flat);
FIELD(steps);
FIELD(grooves);

}  // namespace
