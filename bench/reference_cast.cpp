// The exact reference beside Embree 3 (grid geometry, the leanest it has for height fields) on the same fields and rays. Not the
// same answer: Embree splits each cell into two triangles, in float; the reference solves the bilinear patch, in double. The
// baseline of `ratio` is Embree's packet of 16 on one thread.
#include "core/parallel_for.h"
#include "reference/cast.h"
#include "textures/procedural.h"

#include <benchmark/benchmark.h>
#include <embree3/rtcore.h>

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

// Two by two periods as one grid, x and y in UV, z in UV.
class EmbreeGrid {
public:
    explicit EmbreeGrid(const HeightField& field) : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
        const int side = 2 * field_size + 1;
        RTCGeometry grid = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_GRID);
        auto* vertices = static_cast<float*>(rtcSetNewGeometryBuffer(grid, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                                     static_cast<std::size_t>(side) * static_cast<std::size_t>(side)));
        for (int j = 0; j < side; ++j) {
            for (int i = 0; i < side; ++i) {
                *vertices++ = static_cast<float>((i + 0.5) / field_size);
                *vertices++ = static_cast<float>((j + 0.5) / field_size);
                *vertices++ = static_cast<float>(field.wrapped(i, j) * height_scale);
            }
        }
        auto* description = static_cast<RTCGrid*>(rtcSetNewGeometryBuffer(grid, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), 1));
        *description = {0, static_cast<unsigned>(side), static_cast<unsigned short>(side), static_cast<unsigned short>(side)};
        rtcCommitGeometry(grid);
        rtcAttachGeometry(scene_, grid);
        rtcReleaseGeometry(grid);
        rtcCommitScene(scene_);
    }
    ~EmbreeGrid() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    EmbreeGrid(const EmbreeGrid&) = delete;
    EmbreeGrid& operator=(const EmbreeGrid&) = delete;

    float single(const std::vector<ReferenceRay>& rays) const {
        float sum = 0;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        for (const ReferenceRay& r : rays) {
            RTCRayHit hit{};
            hit.ray.org_x = static_cast<float>(r.uv.x), hit.ray.org_y = static_cast<float>(r.uv.y), hit.ray.org_z = height_scale;
            hit.ray.dir_x = static_cast<float>(-r.uv_per_height.x), hit.ray.dir_y = static_cast<float>(-r.uv_per_height.y);
            hit.ray.dir_z = -height_scale;
            hit.ray.tfar = 1.01f;
            hit.ray.mask = ~0u;
            hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(scene_, &context, &hit);
            sum += hit.ray.tfar;
        }
        return sum;
    }

    float packet16(const std::vector<ReferenceRay>& rays) const {
        float sum = 0;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;  // else a packet is taken apart into single rays
        alignas(64) int valid[16];
        std::fill(valid, valid + 16, -1);
        for (std::size_t first = 0; first < rays.size(); first += 16) {
            alignas(64) RTCRayHit16 hit{};
            for (std::size_t k = 0; k < 16; ++k) {
                const ReferenceRay& r = rays[first + k];
                hit.ray.org_x[k] = static_cast<float>(r.uv.x), hit.ray.org_y[k] = static_cast<float>(r.uv.y), hit.ray.org_z[k] = height_scale;
                hit.ray.dir_x[k] = static_cast<float>(-r.uv_per_height.x), hit.ray.dir_y[k] = static_cast<float>(-r.uv_per_height.y);
                hit.ray.dir_z[k] = -height_scale;
                hit.ray.tfar[k] = 1.01f;
                hit.ray.mask[k] = ~0u;
                hit.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
            }
            rtcIntersect16(valid, scene_, &context, &hit);
            for (const float t : hit.ray.tfar) sum += t;
        }
        return sum;
    }

private:
    RTCDevice device_;
    RTCScene scene_;
};

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
        const auto grid = std::make_shared<EmbreeGrid>(*field);
        for (const int degrees : {60, 30, 15}) {
            const auto rays = std::make_shared<std::vector<ReferenceRay>>(rays_at(degrees));
            const std::string question = id + "/" + std::to_string(degrees);
            const auto add = [&](const char* who, bool is_baseline, Clock clock, std::function<double()> cast) {
                benchmark::RegisterBenchmark((question + "/" + who).c_str(), [=](benchmark::State& state) { run(state, question, is_baseline, clock, cast); })
                    ->UseRealTime()
                    ->Unit(benchmark::kMillisecond);
            };
            add("embree_packet16", true, Clock::cpu, [=] { return grid->packet16(*rays); });
            add("embree_single", false, Clock::cpu, [=] { return grid->single(*rays); });
            add("reference_1_thread", false, Clock::cpu, [=] { return ours(*field, *rays, 1); });
            add("reference_all_threads", false, Clock::wall, [=] { return ours(*field, *rays, 0); });
        }
    }
    return true;
}();

}  // namespace
