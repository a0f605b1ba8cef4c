// Time of the cell cone map on six kinds of field, against the plain way of finding the same bits: from every cell, and toward every
// quadrant, cells in growing rings. Both use all cores and run in turn, A B A B; "ring_scan_over_ours" is the ratio of the medians of
// the run.
#include "core/map_set.h"
#include "core/wrap.h"
#include "fields.h"
#include "maps/cell_cone.h"

#include <benchmark/benchmark.h>

namespace {

using namespace relievo;
using namespace relievo::bench;

// `largest` is the map's own first channel, of which the rings are maxima.
ImageF ring_scan(const ImageF& largest) {
    const int size = largest.width;
    ImageF cones(size, cell_cone_quadrants * size, 4);
    parallel_for(cones.height, 4, 0, [&](int begin, int end) {
        for (int row = begin; row < end; ++row)
            for (int x = 0; x < size; ++x) {
                const int along_x = (row / size & 1) != 0 ? -1 : 1;
                const int along_y = (row / size & 2) != 0 ? -1 : 1;
                const auto at = [&](int a, int b) { return largest(wrap_index(x + along_x * a, size), wrap_index(row % size + along_y * b, size)); };
                float* out = cones.at(x, row);
                float highest = at(0, 0);
                out[0] = highest;
                for (int ring = 1; ring <= far_roof_reach; ++ring) {
                    for (int d = 0; d < ring; ++d) highest = std::max(highest, std::max(at(ring, d), at(d, ring)));
                    highest = std::max(highest, at(ring, ring));
                    if (ring == near_roof_reach) out[1] = highest;
                    if (ring == middle_roof_reach) out[2] = highest;
                }
                out[3] = highest;
            }
    });
    return cones;
}

void cell_cone(benchmark::State& state, float (*shape)(float, float, int), int size, bool against_rings) {
    const HeightField field = make(shape, size);
    std::vector<double> ours;
    std::vector<double> rings;
    ImageF result;
    ImageF scanned;
    for (auto _ : state) {
        ours.push_back(seconds_of([&] { result = cell_cone_map(field); }));
        if (against_rings) {
            ImageF largest(size, size, 1);
            for (std::size_t i = 0; i < largest.texels.size(); ++i) largest.texels[i] = result.texels[4 * i];
            rings.push_back(seconds_of([&] { scanned = ring_scan(largest); }));
        }
        state.SetIterationTime(ours.back());
    }
    state.counters["ours_ms_median"] = 1e3 * median(ours);
    state.counters["ours_ms_min"] = 1e3 * *std::ranges::min_element(ours);
    if (!against_rings) return;
    state.counters["ring_scan_over_ours"] = median(rings) / median(ours);
    if (scanned.texels != result.texels) state.SkipWithError("the two differ");
}

#define FIELD(name) \
    BENCHMARK_CAPTURE(cell_cone, name##_1024, name, 1024, false)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(9); \
    BENCHMARK_CAPTURE(cell_cone, name##_512_against_rings, name, 512, true)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(3)
FIELD(fbm);
FIELD(cobbles);
FIELD(spikes);
FIELD(flat);
FIELD(steps);
FIELD(grooves);

}  // namespace
