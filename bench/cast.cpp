// The CPU caster beside Embree 3's packets of 16 on the same rays, hit UV and distance written out by both: each question is
// measured in turns (grid, triangles, ours, ours, triangles, grid), the median of which counts. `ratio` is ours over the better of
// Embree's two; the last line is its geometric mean over all questions. One thread goes by the thread's own clock, which a busy
// machine disturbs least; all threads by the wall's.
//
// Rays of a picture from far away, whose pixels are a texel wide in the plane (/near, /all_threads) or four texels (/4x); blocks of
// 4x4 pixels are packets.
#include "cast/height_field_caster.h"
#include "core/parallel_for.h"
#include "embree_surface.h"
#include "techniques/adversarial_fields.h"
#include "textures/procedural.h"

#include <benchmark/benchmark.h>

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>

using namespace relievo;

namespace {

constexpr int field_size = 1024;
constexpr double height_scale = 0.1;
constexpr int picture_side = 256;
constexpr int ray_count = picture_side * picture_side;
constexpr int margin = 420;  // texels a ray at 15 degrees goes, and some

HeightField field_of(const std::string& id) {
    if (id == "fbm") return adversarial::fbm(field_size, field_size, 1);
    if (id == "thin_spikes") return adversarial::spikes(field_size, field_size, 1);
    if (id == "steps")
        return adversarial::filled(field_size, field_size,
                                   [](int i, int j) { return ((i / 52) * 7 + (j / 44) * 5) % 3 == 0 ? 1.0 : 0.0; });
    return procedural_material(id, field_size, 1, 0).height;
}

// One field ready to be asked. Only one is held at a time: Embree's trees take gigabytes.
struct Ready {
    std::string id;
    HeightFieldCaster caster, caster_all_threads;
    EmbreeSurface grid, triangles;
    explicit Ready(const std::string& name, const HeightField& field)
        : id(name),
          caster(field, {.threads = 1}),
          caster_all_threads(field),
          grid(field, height_scale, EmbreeGeometry::grid, -margin, field_size),
          triangles(field, height_scale, EmbreeGeometry::triangles, -margin, field_size) {}
};

const Ready& ready(const std::string& id) {
    static std::unique_ptr<Ready> held;
    if (!held || held->id != id) {
        held.reset();
        held = std::make_unique<Ready>(id, field_of(id));
    }
    return *held;
}

struct Question {
    std::string id;
    double elevation_deg;
    int stride;  // texels between rays
    bool one_thread;
};

std::vector<CastRay> rays_at(double elevation_deg, int stride) {
    const double reach = height_scale / std::tan(elevation_deg * std::numbers::pi / 180);
    const double azimuth = 0.7;  // along nothing
    std::vector<CastRay> rays;
    for (int k = 0; k < ray_count; ++k) {
        const int block = k / 16;
        const int x = block % (picture_side / 4) * 4 + k % 4;
        const int y = block / (picture_side / 4) * 4 + k / 4 % 4;
        rays.push_back(
            {.uv = {static_cast<float>((x + 0.5) * stride / field_size), static_cast<float>((y + 0.5) * stride / field_size)},
             .uv_per_height = {static_cast<float>(std::cos(azimuth) * reach), static_cast<float>(std::sin(azimuth) * reach)}});
    }
    return rays;
}

std::vector<EmbreeRay> as_embree(const std::vector<CastRay>& rays) {
    std::vector<EmbreeRay> same;
    for (const CastRay& r : rays)
        same.push_back(
            {{r.uv.x, r.uv.y, static_cast<float>(height_scale)}, {r.uv.x - r.uv_per_height.x, r.uv.y - r.uv_per_height.y, 0}});
    return same;
}

double now(bool own_clock) {
    if (!own_clock) return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

struct Ratios {
    double log_sum = 0;
    double least = 1e9;
    int count = 0;
};

void measure(benchmark::State& state, const Question& q, Ratios& ratios) {
    const Ready& field = ready(q.id);
    const bool one_thread = q.one_thread;
    const std::vector<CastRay> rays = rays_at(q.elevation_deg, q.stride);
    const EmbreePackets packets = embree_packets(as_embree(rays));
    std::vector<EmbreeHit> embree_hits(rays.size());
    std::vector<CastHit> hits(rays.size());
    const auto embree = [&](const EmbreeSurface& surface) {
        if (one_thread) return surface.packet16(packets, 0, packets.packets.size(), embree_hits.data());
        parallel_for(static_cast<int>(packets.packets.size()), 256, 0, [&](int begin, int end) {
            surface.packet16(packets, static_cast<std::size_t>(begin), static_cast<std::size_t>(end), embree_hits.data());
        });
    };
    const std::function<void()> who[] = {[&] { embree(field.grid); }, [&] { embree(field.triangles); },
                                         [&] { (one_thread ? field.caster : field.caster_all_threads).cast(rays, hits); }};
    std::vector<double> times[3];
    for (auto _ : state) {
        for (const int k : {0, 1, 2, 2, 1, 0}) {
            const double start = now(one_thread);
            who[k]();
            times[k].push_back(now(one_thread) - start);
        }
        state.SetIterationTime(times[2].back());
    }
    double rate[3];
    for (int k = 0; k < 3; ++k) rate[k] = ray_count / median(times[k]) / 1e6;
    const double ratio = rate[2] / std::max(rate[0], rate[1]);
    state.counters["grid"] = rate[0];
    state.counters["triangles"] = rate[1];
    state.counters["ours"] = rate[2];
    state.counters["ratio"] = ratio;
    ratios.log_sum += std::log(ratio);
    ratios.least = std::min(ratios.least, ratio);
    ++ratios.count;
}

const bool registered = [] {
    static Ratios one_texel, four_texels, all_threads;
    const auto add = [](const std::string& name, const Question& q, Ratios& ratios) {
        benchmark::RegisterBenchmark(name.c_str(), [=, &ratios](benchmark::State& state) { measure(state, q, ratios); })
            ->UseManualTime()
            ->Iterations(6)
            ->Unit(benchmark::kMillisecond);
    };
    for (const std::string id : {"fbm", "cobbles", "thin_spikes", "dunes", "bricks", "steps"}) {
        for (const int degrees : {60, 30, 15}) {
            const std::string name = id + "/" + std::to_string(degrees);
            add(name + "/near", {id, static_cast<double>(degrees), 1, true}, one_texel);
            add(name + "/all_threads", {id, static_cast<double>(degrees), 1, false}, all_threads);
            add(name + "/4x", {id, static_cast<double>(degrees), 4, true}, four_texels);
        }
        benchmark::RegisterBenchmark((id + "/build").c_str(),
                                     [id](benchmark::State& state) {
                                         const HeightField field = field_of(id);
                                         for (auto _ : state) benchmark::DoNotOptimize(HeightFieldCaster(field));
                                         const double start = now(false);
                                         const EmbreeSurface grid(field, height_scale, EmbreeGeometry::grid, 0, field_size);
                                         state.counters["grid_ms"] = 1e3 * (now(false) - start);
                                         state.counters["grid_bytes_a_texel"] =
                                             static_cast<double>(grid.bytes()) / (field_size * field_size);
                                     })
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
    }
    for (const auto& [name, ratios] : {std::pair<const char*, Ratios*>{"ratios/near", &one_texel},
                                       {"ratios/all_threads", &all_threads},
                                       {"ratios/4x", &four_texels}})
        benchmark::RegisterBenchmark(name, [ratios](benchmark::State& state) {
            for (auto _ : state) {
            }
            state.counters["geometric_mean"] = std::exp(ratios->log_sum / std::max(ratios->count, 1));
            state.counters["least"] = ratios->least;
            state.counters["questions"] = ratios->count;
        })->Iterations(1);
    return true;
}();

}  // namespace
