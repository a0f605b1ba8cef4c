// Time of the cell cone map on six kinds of field, against the plain way of finding the same bits: the cells around a cell one by one,
// then texels in growing rings until a ring is too far away to matter. Both use all cores and run in turn, A B A B;
// "ring_scan_over_ours" is the ratio of the medians of the run.
#include "fields.h"
#include "maps/cell_cone.h"

#include <benchmark/benchmark.h>


namespace {

using namespace relievo;
using namespace relievo::bench;

// Largest squared slope of a height going linearly from n at t0 to f at t0 + unit, over sqrt(t^2 + e2), or `least`.
float steepest(float least, float n, float f, float t0, float unit, float e2) {
    const float t1 = t0 + unit;
    const float near2 = t0 * t0 + e2;
    if (near2 > 0 && n > 0) least = std::max(least, n * n * (1 / near2));
    if (f > 0) least = std::max(least, f * f * (1 / (t1 * t1 + e2)));
    if (e2 > 0) {
        const float b = (f - n) * (1 / unit);
        const float a = n - b * t0;
        const float foot = b * e2;
        if (a > 0 && foot > a * t0 && foot < a * t1) least = std::max(least, a * a * (1 / e2) + b * b);
    }
    return least;
}

// A cell within two of cell (x, y), seen from it: maps/cell_cone.cpp's bound, for square fields.
float near_slope(const HeightField& field, int x, int y, int ox, int oy, float m, float unit) {
    const float gap_x = static_cast<float>(std::max(0, std::abs(ox) - 1)) * unit;
    const float gap_y = static_cast<float>(std::max(0, std::abs(oy) - 1)) * unit;
    const int near_x = x + (ox > 0 ? ox : ox + 1), far_x = x + (ox > 0 ? ox + 1 : ox);
    const int near_y = y + (oy > 0 ? oy : oy + 1), far_y = y + (oy > 0 ? oy + 1 : oy);
    if (std::abs(ox) == 1 && std::abs(oy) == 1) {
        const float a = std::max(0.0f, field.wrapped(far_x, near_y) - m);
        const float b = std::max(0.0f, field.wrapped(near_x, far_y) - m);
        const float d = field.wrapped(far_x, far_y) - m;
        const float u2 = unit * unit;
        return steepest(steepest(a * a * (1 / u2) + b * b * (1 / u2), a, d, 0, unit, u2), b, d, 0, unit, u2);
    }
    float across = 1e30f;
    float along = 1e30f;
    if (ox != 0) {
        const float n = std::max(field.wrapped(near_x, y + oy), field.wrapped(near_x, y + oy + 1));
        const float f = std::max(field.wrapped(far_x, y + oy), field.wrapped(far_x, y + oy + 1));
        across = steepest(0, n - m, f - m, gap_x, unit, gap_y * gap_y);
    }
    if (oy != 0) {
        const float n = std::max(field.wrapped(x + ox, near_y), field.wrapped(x + ox + 1, near_y));
        const float f = std::max(field.wrapped(x + ox, far_y), field.wrapped(x + ox + 1, far_y));
        along = steepest(0, n - m, f - m, gap_y, unit, gap_x * gap_x);
    }
    return std::min(across, along);
}

// The squared slopes of maps/cell_cone.cpp by rings; squares only.
std::vector<float> ring_scan(const HeightField& field) {
    const int size = field.width();
    const float unit = 1.0f / static_cast<float>(size);
    const float nearer = 0.25f * (unit * unit + unit * unit);
    const float highest = *std::ranges::max_element(field.texels.texels);
    std::vector<float> slopes(field.texels.texels.size());
    parallel_for(size, 4, 0, [&](int begin, int end) {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < size; ++x) {
                const auto corners = field.cell(x, y);
                const float m = *std::ranges::max_element(corners);
                float k2 = 1;
                for (int oy = -2; oy <= 2; ++oy)
                    for (int ox = -2; ox <= 2; ++ox)
                        if (ox != 0 || oy != 0) k2 = std::max(k2, near_slope(field, x, y, ox, oy, m, unit));
                const auto visit = [&](int i, int j) {
                    const float rise = field.wrapped(i, j) - m;
                    if (rise <= 0) return;
                    const float u = static_cast<float>(std::max({0, i - x - 1, x - i})) * unit;
                    const float v = static_cast<float>(std::max({0, j - y - 1, y - j})) * unit;
                    k2 = std::max(k2, rise * rise / (u * u - nearer + v * v));
                };
                const float most = highest - m;
                for (int gap = 2; gap <= size && most > 0; ++gap) {
                    const float nearest = static_cast<float>(gap) * unit;
                    if ((nearest * nearest - nearer) * k2 * 0.99999f >= most * most) break;
                    for (int d = -gap; d <= gap + 1; ++d) {
                        visit(x + d, y - gap);
                        visit(x + d, y + 1 + gap);
                    }
                    for (int d = 1 - gap; d <= gap; ++d) {
                        visit(x - gap, y + d);
                        visit(x + 1 + gap, y + d);
                    }
                }
                slopes[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)] = k2;
            }
    });
    return slopes;
}

void cell_cone(benchmark::State& state, float (*shape)(float, float, int), int size, bool against_rings) {
    const HeightField field = make(shape, size);
    std::vector<double> ours;
    std::vector<double> rings;
    ImageF result;
    std::vector<float> slopes;
    for (auto _ : state) {
        ours.push_back(seconds_of([&] { result = cell_cone_map(field); }));
        if (against_rings) rings.push_back(seconds_of([&] { slopes = ring_scan(field); }));
        state.SetIterationTime(ours.back());
    }
    state.counters["ours_ms_median"] = 1e3 * median(ours);
    state.counters["ours_ms_min"] = 1e3 * *std::ranges::min_element(ours);
    if (!against_rings) return;
    state.counters["ring_scan_over_ours"] = median(rings) / median(ours);
    // In 16 bits and rounded down, ratios differ where the last bits of a slope do.
    for (std::size_t i = 0; i < slopes.size(); ++i)
        if (std::abs(result.texels[4 * i + 1] - 1 / std::sqrt(slopes[i])) > 2.0f / 65535) state.SkipWithError("the two differ");
}

#define FIELD(name) \
    BENCHMARK_CAPTURE(cell_cone, name##_1024, name, 1024, false)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(5); \
    BENCHMARK_CAPTURE(cell_cone, name##_512_against_rings, name, 512, true)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(3)
FIELD(fbm);
FIELD(cobbles);
FIELD(spikes);
FIELD(flat);
FIELD(steps);
FIELD(grooves);

}  // namespace
