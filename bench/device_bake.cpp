// Time of the maps that a Vulkan device can bake, on it and on the CPU in turn, A B A B: heights in memory to the map in memory,
// which is the same to the bit. The device is the first real GPU, else a software one; the label says which. Its start and the
// compiling of its programs are timed apart, once.
#include "render/device_bake.h"
#include "core/error.h"
#include "fields.h"
#include "maps/map_kinds.h"

#include <benchmark/benchmark.h>

#include <memory>
#include <string>

namespace {

using namespace relievo;
using namespace relievo::bench;

constexpr float height_scale = 0.1f;

// Null where there is no device.
DeviceBaker* device() {
    static const std::unique_ptr<DeviceBaker> baker = [] {
        try {
            return std::make_unique<DeviceBaker>("", false);
        } catch (const Error&) {
            return std::unique_ptr<DeviceBaker>();
        }
    }();
    return baker.get();
}

void bake(benchmark::State& state, Map map, float (*shape)(float, float, int), int size) {
    if (device() == nullptr) return state.SkipWithError("no Vulkan device");
    const Progress silent;
    const MapBake settings{.height_scale = height_scale, .threads = 0, .progress = silent};
    const MapKind& kind = map_kind(map);
    MapSet maps;
    maps.height = make(shape, size);
    ImageF baked = device()->bake(map, maps.height, settings);  // compiles, where nobody did yet
    std::vector<double> on_device, on_cpu;
    for (auto _ : state) {
        on_device.push_back(seconds_of([&] { baked = device()->bake(map, maps.height, settings); }));
        on_cpu.push_back(seconds_of([&] { kind.bake(maps, settings); }));
        state.SetIterationTime(on_device.back());
    }
    state.counters["device_ms"] = 1e3 * median(on_device);
    state.counters["cpu_ms"] = 1e3 * median(on_cpu);
    state.counters["cpu_over_device"] = median(on_cpu) / median(on_device);
    state.SetLabel(device()->device_name());
    if (baked.texels != (maps.*kind.image).texels) state.SkipWithError("the two differ");
}

// What a program that bakes one map pays before: a device of its own, and its programs at their first bake.
void start(benchmark::State& state, Map map) {
    if (device() == nullptr) return state.SkipWithError("no Vulkan device");
    const Progress silent;
    const HeightField field(16, 16);
    std::vector<double> starts, firsts;
    for (auto _ : state) {
        std::unique_ptr<DeviceBaker> baker;
        starts.push_back(seconds_of([&] { baker = std::make_unique<DeviceBaker>("", false); }));
        firsts.push_back(
            seconds_of([&] { baker->bake(map, field, {.height_scale = height_scale, .threads = 0, .progress = silent}); }));
        state.SetIterationTime(starts.back() + firsts.back());
    }
    state.counters["start_ms"] = 1e3 * median(starts);
    state.counters["first_bake_ms"] = 1e3 * median(firsts);
    state.SetLabel(device()->device_name());
}

struct Shape {
    const char* name;
    float (*height)(float, float, int);
};

const bool registered = [] {
    for (const Map map : device_baked_maps()) {
        const std::string id(map_kind(map).id);
        const auto timed = [](benchmark::internal::Benchmark* b, int turns) {
            b->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(turns);
        };
        timed(benchmark::RegisterBenchmark(("start/" + id).c_str(), [map](benchmark::State& state) { start(state, map); }), 3);
        for (const Shape& shape : {Shape{"fbm", fbm}, Shape{"spikes", spikes}})
            for (const int size : {512, 1024, 2048})
                timed(benchmark::RegisterBenchmark(
                          (id + "/" + shape.name + "/" + std::to_string(size)).c_str(),
                          [map, shape, size](benchmark::State& state) { bake(state, map, shape.height, size); }),
                      5);
    }
    return true;
}();

}  // namespace
