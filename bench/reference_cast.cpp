// The exact reference beside Embree 3 (grid geometry, the leanest it has for height fields) on the same fields and rays. Not the
// same answer: Embree splits each cell into two triangles, in float; the reference solves the bilinear patch, in double. The
// baseline of `ratio` is Embree's packet of 16 on one thread.
#include "core/parallel_for.h"
#include "embree_surface.h"
#include "reference/cast.h"
#include "textures/procedural.h"

#include <benchmark/benchmark.h>

#include <chrono>
#include <ctime>
#include <functional>
#include <map>
#include <memory>
#include <numbers>
#include <string>

using namespace relievo;

namespace {

constexpr int field_size = 1024;
constexpr double height_scale = 0.1;
constexpr int ray_count = 1 << 16;

HeightField field_of(const std::string& id) { return procedural_material(id, field_size, 1, 0).height; }

// The rays of a picture from far away, in blocks of 4 x 4 so that a packet is coherent. They meet the polygon in [1/2, 3/2]^2, so
// that at 15 degrees (0.37 of a period) they stay in two periods.
std::vector<ReferenceRay> rays_at(double elevation_deg) {
    const double reach = height_scale / std::tan(elevation_deg * std::numbers::pi / 180);
    const double azimuth = 0.7;  // along nothing
    const int side = 256;
    static_assert(side * side == ray_count);
    std::vector<ReferenceRay> rays;
    for (int k = 0; k < ray_count; ++k) {
        const int block = k / 16;
        const int x = block % (side / 4) * 4 + k % 4;
        const int y = block / (side / 4) * 4 + k / 4 % 4;
        rays.push_back({.uv = {0.5 + (x + 0.5) / side, 0.5 + (y + 0.5) / side},
                        .uv_per_height = Vec2d{std::cos(azimuth), std::sin(azimuth)} * reach});
    }
    return rays;
}

std::vector<EmbreeRay> as_embree(const std::vector<ReferenceRay>& rays) {
    std::vector<EmbreeRay> same;
    for (const ReferenceRay& r : rays) {
        const Vec2f from(r.uv), to(r.uv - r.uv_per_height);
        same.push_back({{from.x, from.y, static_cast<float>(height_scale)}, {to.x, to.y, 0}});
    }
    return same;
}

double ours(const HeightField& field, const std::vector<ReferenceRay>& rays, int threads) {
    std::vector<double> sums(rays.size() / 1024);
    parallel_for(static_cast<int>(sums.size()), 1, threads, [&](int begin, int end) {
        for (int b = begin; b < end; ++b)
            for (int k = b * 1024; k < (b + 1) * 1024; ++k)
                sums[static_cast<std::size_t>(b)] += reference_cast(field, rays[static_cast<std::size_t>(k)]).height;
    });
    double sum = 0;
    for (const double s : sums) sum += s;
    return sum;
}

enum class Clock { cpu, wall };

// Runs `cast` until the benchmark has enough, reports rays per second, and the ratio to the baseline of the same field and view,
// which is registered (and so runs) first. One thread is timed by the CPU's clock, which a busy machine disturbs least.
void run(benchmark::State& state, const std::string& question, bool is_baseline, Clock clock, const std::function<double()>& cast) {
    static std::map<std::string, double> baselines;
    const auto wall_start = std::chrono::steady_clock::now();
    const std::clock_t cpu_start = std::clock();
    for (auto _ : state) benchmark::DoNotOptimize(cast());
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_start).count();
    const double cpu = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
    const double seconds = clock == Clock::cpu ? cpu : wall;
    const double rate = static_cast<double>(state.iterations()) * ray_count / seconds;
    if (is_baseline) baselines[question] = rate;
    state.counters["Mrays/s"] = rate / 1e6;
    const auto baseline = baselines.find(question);
    if (baseline != baselines.end()) state.counters["ratio"] = rate / baseline->second;
}

const bool registered = [] {
    for (const std::string id : {"dunes", "cobbles", "spikes"}) {
        const auto field = std::make_shared<HeightField>(field_of(id));
        const auto grid = std::make_shared<EmbreeSurface>(*field, height_scale, EmbreeGeometry::grid, 0, 2 * field_size);
        for (const int degrees : {60, 30, 15}) {
            const auto rays = std::make_shared<std::vector<ReferenceRay>>(rays_at(degrees));
            const auto same = std::make_shared<std::vector<EmbreeRay>>(as_embree(*rays));
            const auto packets = std::make_shared<EmbreePackets>(embree_packets(*same));
            const auto hits = std::make_shared<std::vector<EmbreeHit>>(rays->size());
            const std::string question = id + "/" + std::to_string(degrees);
            const auto add = [&](const char* who, bool is_baseline, Clock clock, std::function<double()> cast) {
                benchmark::RegisterBenchmark((question + "/" + who).c_str(),
                                             [=](benchmark::State& state) { run(state, question, is_baseline, clock, cast); })
                    ->UseRealTime()
                    ->Unit(benchmark::kMillisecond);
            };
            add("embree_packet16", true, Clock::cpu, [=] {
                grid->packet16(*packets, 0, packets->packets.size(), hits->data());
                return static_cast<double>(hits->back().distance);
            });
            add("embree_single", false, Clock::cpu, [=] {
                grid->single(*same, hits->data());
                return static_cast<double>(hits->back().distance);
            });
            add("reference_1_thread", false, Clock::cpu, [=] { return ours(*field, *rays, 1); });
            add("reference_all_threads", false, Clock::wall, [=] { return ours(*field, *rays, 0); });
        }
    }
    return true;
}();

}  // namespace
