// FLIP as it is against the same metric with two-dimensional kernels (the plain double computation of the tests).
#include "measure/flip.h"

#include "../tests/measure/flip_direct.h"
#include "../tests/measure/pictures.h"

#include <benchmark/benchmark.h>
#include <chrono>

namespace relievo {
namespace {

// The slow one takes minutes at full size; its cost is per pixel, so a small picture tells its time.
double direct_ms_per_pixel() {
    static const double ms = [] {
        constexpr int width = 160, height = 90;
        const ImageF a = test::random_picture(width, height, 1), b = test::random_picture(width, height, 2);
        const auto start = std::chrono::steady_clock::now();
        benchmark::DoNotOptimize(test::DirectFlip(67)(a, b));
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() / (width * height);
    }();
    return ms;
}

void flip_pair(benchmark::State& state) {
    const int width = static_cast<int>(state.range(0)), height = static_cast<int>(state.range(1)), threads = static_cast<int>(state.range(2));
    const ImageF a = test::random_picture(width, height, 1), b = test::random_picture(width, height, 2);
    const double direct_ms = direct_ms_per_pixel() * width * height;
    const auto start = std::chrono::steady_clock::now();
    for (auto _ : state) benchmark::DoNotOptimize(flip(a, b, {.threads = threads}).mean);
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() /
                      static_cast<double>(state.iterations());
    state.counters["direct_ms"] = direct_ms;
    state.counters["times_direct"] = direct_ms / ms;
}
BENCHMARK(flip_pair)->ArgNames({"width", "height", "threads"})->Args({1280, 720, 1})->Args({1280, 720, 2})->Args({800, 450, 2})
    ->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace relievo
