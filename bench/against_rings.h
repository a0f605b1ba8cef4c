// How a baker of maps is timed beside a scan in growing rings: in turn, A B A B, both on all cores. The scan takes seconds to
// minutes where the baker takes a fraction of one, so that it does every k-th row only, spread evenly over the map, and its time
// counts k times; k is chosen so that a turn of it lasts a third of a second or more, and reported as "of_rows".
// "ring_scan_over_ours" is the ratio of the medians of the processor time of all threads, which other programs disturb little;
// "ours_ms" is time on the clock.
#pragma once

#include "fields.h"

#include <benchmark/benchmark.h>

#include <map>
#include <string>

namespace relievo::bench {

struct RingRatio {
    std::string field;
    double ratio;
};
inline std::map<std::string, std::vector<RingRatio>>& ring_ratios() {
    static std::map<std::string, std::vector<RingRatio>> all;
    return all;
}

// bake() makes the whole map; scan(y) does row y by rings; agrees(y) compares the two.
void against_rings(benchmark::State& state, const std::string& map, const std::string& field, int rows, const auto& bake,
                   const auto& scan, const auto& agrees) {
    const auto scan_every = [&](int k) {
        parallel_for((rows + k - 1) / k, 1, 0, [&](int begin, int end) {
            for (int n = begin; n < end; ++n) scan(std::min(rows - 1, n * k + k / 2));
        });
    };
    // Odd, so that volumes whose slices have 2^n rows are not met in the same row each time.
    int every = rows / 8 | 1;
    while (every > 1 && processor_seconds_of([&] { scan_every(every); }) < 0.3) every = every > 3 ? every / 2 | 1 : 1;
    std::vector<double> ours;
    std::vector<double> processor;
    std::vector<double> rings;
    for (auto _ : state) {
        processor.push_back(processor_seconds_of([&] { ours.push_back(seconds_of(bake)); }));
        rings.push_back(every * processor_seconds_of([&] { scan_every(every); }));
        state.SetIterationTime(ours.back());
    }
    const double ratio = median(rings) / median(processor);
    state.counters["ours_ms_median"] = 1e3 * median(ours);
    state.counters["ours_ms_min"] = 1e3 * *std::ranges::min_element(ours);
    state.counters["ours_processor_ms"] = 1e3 * median(processor);
    state.counters["ring_scan_over_ours"] = ratio;
    state.counters["of_rows"] = every;
    for (int n = 0; n * every < rows; ++n)
        if (!agrees(std::min(rows - 1, n * every + every / 2))) return state.SkipWithError("the two differ");
    ring_ratios()[map].push_back({field, ratio});
}

// Geometric means of the ratios above, over the fields that ran before, and without those on which the scan's first ring decides.
inline void mean_of_ratios(benchmark::State& state, const std::string& map) {
    double all = 0;
    double harder = 0;
    int count = 0;
    int count_harder = 0;
    for (auto _ : state)
        for (const RingRatio& r : ring_ratios()[map]) {
            all += std::log(r.ratio);
            ++count;
            if (r.field == "flat") continue;
            harder += std::log(r.ratio);
            ++count_harder;
        }
    state.counters["geometric_mean"] = std::exp(all / std::max(1, count));
    state.counters["without_flat"] = std::exp(harder / std::max(1, count_harder));
    state.counters["fields"] = count;
}

}  // namespace relievo::bench
