// Time of the exact cones of the bilinear surface on six kinds of field, against the plain way of finding the conservative ones: a scan
// in growing rings of cells that stops once a ring is too far away to matter (against_rings.h). The scan looks at corners and edges only and
// leaves out the insides of cells, which favours it. And the time of proving a map with the verifier, with the share of cones that it
// finds broken.
#include "against_rings.h"
#include "maps/cone_map.h"
#include "maps/cone_verifier.h"
#include "maps/conservative_cone.h"
#include "maps/quick_cone.h"
#include "maps/relaxed_cone.h"
#include "maps/robust_cone.h"
#include "maps/safe_rounding.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace relievo;
using namespace relievo::bench;

using Shape = float (*)(float, float, int);
using Baker = ImageF (*)(const HeightField&, int, const Progress&);

// One texel's cone; `falling` leaves out points at which the surface does not fall outward, seen from the texel.
class RingScan {
public:
    RingScan(const HeightField& field, bool falling)
        : field_(field), falling_(falling), w_(field.width()), h_(field.height()), u2_(1.0f / static_cast<float>(w_ * w_)), v2_(1.0f / static_cast<float>(h_ * h_)) {}

    float ratio(int x, int y, float highest) {
        q_ = 1;
        apex_ = field_.texels(x, y);
        const float most = highest - apex_;
        const float shorter = 1.0f / static_cast<float>(std::max(w_, h_));
        for (int r = 0; r <= std::max(w_, h_) && most > 0; ++r) {
            const float nearest = static_cast<float>(r) * shorter;
            if (nearest * nearest * 0.99999f >= q_ * most * most) break;
            // Cells at r whole cells from the texel, on all four sides: columns and rows -r - 1 and r.
            for (int d = -r - 1; d <= r; ++d) {
                cell(x, y, d, r);
                cell(x, y, d, -r - 1);
            }
            for (int d = -r; d < r; ++d) {
                cell(x, y, r, d);
                cell(x, y, -r - 1, d);
            }
        }
        return std::sqrt(q_);
    }

private:
    void cell(int x, int y, int i, int j) {
        const auto c = field_.cell(x + i, y + j);
        const bool right = i >= 0;
        const bool up = j >= 0;
        // Steps between corners and not between heights relative to the texel's: those would be rounded, and their signs matter.
        const float c00 = c[(right ? 0u : 1u) + (up ? 0u : 2u)], c10 = c[(right ? 1u : 0u) + (up ? 0u : 2u)];
        const float c01 = c[(right ? 0u : 1u) + (up ? 2u : 0u)], c11 = c[(right ? 1u : 0u) + (up ? 2u : 0u)];
        if (std::max(std::max(c00, c10), std::max(c01, c11)) <= apex_) return;
        const float px = static_cast<float>(right ? i : -1 - i);
        const float py = static_cast<float>(up ? j : -1 - j);
        const float corner = px * (c10 - c00) + py * (c01 - c00);
        edge(c00 - apex_, c01 - apex_, px * px * u2_, py, v2_, corner, px * (c11 - c01) + (py + 1) * (c01 - c00));
        edge(c00 - apex_, c10 - apex_, py * py * v2_, px, u2_, corner, py * (c11 - c10) + (px + 1) * (c10 - c00));
    }

    void edge(float h0, float h1, float e2, float along, float s2, float fall0, float fall1) {
        float low = 0;
        float high = 1;
        if (falling_) {
            if (fall0 >= 0 && fall1 >= 0) return;
            if (fall0 >= 0) low = fall0 / (fall0 - fall1);
            if (fall1 >= 0) high = fall0 / (fall0 - fall1);
        }
        const float foot = (h0 - (h1 - h0) * along) * s2;
        const float v = foot > 0 ? std::clamp((h1 - h0) * e2 / foot - along, low, high) : high;
        const float rise = v < 0.5f ? h0 + (h1 - h0) * v : h1 - (h1 - h0) * (1 - v);
        if (rise > 0) q_ = std::min(q_, (e2 + (along + v) * (along + v) * s2) / (rise * rise));
    }

    const HeightField& field_;
    bool falling_;
    int w_, h_;
    float u2_, v2_;
    float apex_ = 0;
    float q_ = 1;
};

void bake(benchmark::State& state, Baker baker, const std::string& map, Shape shape, const std::string& name, bool falling) {
    const HeightField field = make(shape, 1024);
    const float highest = *std::ranges::max_element(field.texels.texels);
    ImageF result;
    ImageF scanned(field.width(), field.height(), 1);
    against_rings(
        state, map, name, field.height(), [&] { result = baker(field, 0, {}); },
        [&](int y) {
            RingScan scan(field, falling);
            for (int x = 0; x < field.width(); ++x) scanned(x, y) = scan.ratio(x, y, highest);
        },
        [&](int y) {
            for (int x = 0; x < field.width(); ++x)
                if (result(x, y, 1) > scanned(x, y) * 1.00001f) return false;
            return true;
        });
}

void prove(benchmark::State& state, Shape shape, const std::string& kind) {
    const HeightField field = make(shape, 512);
    const ImageF map = kind == "conservative" ? conservative_cone(field)
                       : kind == "relaxed"    ? relaxed_cone(field)
                       : kind == "sampled"    ? cone_map(field)
                       : kind == "quick"      ? quick_cone(field)
                                              : robust_cone(field);
    const ImageF stored = as_stored(map, {Rounding::up, Rounding::down, Rounding::nearest, Rounding::nearest});
    const std::vector<ConeApex> cones = kind == "robust" ? scattered_cones(field, stored, 1) : texel_cones(stored);
    Verification v;
    for (auto _ : state) v = verify_cones(field, cones, kind == "relaxed" ? ConePromise::relaxed : ConePromise::conservative);
    state.counters["violated_percent"] = 100.0 * static_cast<double>(v.violated) / static_cast<double>(v.cones);
    state.counters["undecided"] = static_cast<double>(v.undecided);
    state.counters["checks"] = static_cast<double>(v.checks);
    state.counters["pairs"] = static_cast<double>(v.pairs);
}

#define BAKE(kind, name, falling) \
    BENCHMARK_CAPTURE(bake, kind##_##name##_1024, kind##_cone, #kind, name, #name, falling)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(3)
#define BAKES(kind, falling) \
    BAKE(kind, fbm, falling); \
    BAKE(kind, cobbles, falling); \
    BAKE(kind, spikes, falling); \
    BAKE(kind, flat, falling); \
    BAKE(kind, steps, falling); \
    BAKE(kind, grooves, falling); \
    BENCHMARK_CAPTURE(mean_of_ratios, kind, #kind)->Iterations(1)
BAKES(conservative, false);
BAKES(relaxed, true);

#define FIELD(name) \
    BENCHMARK_CAPTURE(prove, name##_conservative, name, "conservative")->UseRealTime()->Unit(benchmark::kMillisecond)->Iterations(1); \
    BENCHMARK_CAPTURE(prove, name##_relaxed, name, "relaxed")->UseRealTime()->Unit(benchmark::kMillisecond)->Iterations(1); \
    BENCHMARK_CAPTURE(prove, name##_sampled, name, "sampled")->UseRealTime()->Unit(benchmark::kMillisecond)->Iterations(1); \
    BENCHMARK_CAPTURE(prove, name##_quick, name, "quick")->UseRealTime()->Unit(benchmark::kMillisecond)->Iterations(1); \
    BENCHMARK_CAPTURE(prove, name##_robust, name, "robust")->UseRealTime()->Unit(benchmark::kMillisecond)->Iterations(1)
FIELD(fbm);
FIELD(cobbles);
FIELD(spikes);
FIELD(flat);
FIELD(steps);
FIELD(grooves);

}  // namespace
