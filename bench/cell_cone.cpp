// Time of the cell cone map on six kinds of field, against the plain way of finding the same bits: from every cell, and toward every
// quadrant, cells in growing rings (against_rings.h).
#include "against_rings.h"
#include "core/map_set.h"
#include "core/wrap.h"
#include "maps/cell_cone.h"

#include <benchmark/benchmark.h>

namespace {

using namespace relievo;
using namespace relievo::bench;

// A row of the map. `largest` is the map's own first channel, of which the rings are maxima.
void ring_row(const ImageF& largest, int row, ImageF& cones) {
    const int size = largest.width;
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
}

void cell_cone(benchmark::State& state, float (*shape)(float, float, int), const std::string& name) {
    const HeightField field = make(shape, 1024);
    ImageF result = cell_cone_map(field);
    ImageF largest(1024, 1024, 1);
    for (std::size_t i = 0; i < largest.texels.size(); ++i) largest.texels[i] = result.texels[4 * i];
    ImageF scanned(result.width, result.height, 4);
    against_rings(
        state, "cell_cone", name, result.height, [&] { result = cell_cone_map(field); }, [&](int row) { ring_row(largest, row, scanned); },
        [&](int row) { return std::equal(result.at(0, row), result.at(0, row) + 4 * result.width, scanned.at(0, row)); });
}

#define FIELD(name) BENCHMARK_CAPTURE(cell_cone, name##_1024, name, #name)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(9)
FIELD(fbm);
FIELD(cobbles);
FIELD(spikes);
FIELD(flat);
FIELD(steps);
FIELD(grooves);
BENCHMARK_CAPTURE(mean_of_ratios, all, "cell_cone")->Iterations(1);

}  // namespace
