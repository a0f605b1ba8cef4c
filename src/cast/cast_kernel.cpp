// The caster's inner loop, compiled once per instruction set (Highway's foreach_target includes this file again for each) and
// chosen at run time. docs/concepts/cpu_caster.md says how it works and why it cannot miss.
#include "cast/cast_grid.h"

#include <algorithm>
#include <cstddef>

// SSSE3 alone gains nothing over plain code here; fewer copies compile faster.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS HWY_SSSE3
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cast/cast_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "cast/fours.h"
#include "cast/lanes.h"
#include "cast/walk_alone.h"
#include "cast/walk_together.h"

HWY_BEFORE_NAMESPACE();
namespace relievo {
namespace HWY_NAMESPACE {

static_assert(sizeof(CastHit) == 4 * sizeof(float) && offsetof(CastHit, height) == 8 && offsetof(CastHit, found) == 12);

// The four floats of each hit side by side; `flag` holds the bits of `found` and its padding.
HWY_INLINE void store_hits(F u, F v, F height, F flag, CastHit* hits) {
#if HWY_TARGET == HWY_SCALAR
    hits[0] = {.uv = {hn::GetLane(u), hn::GetLane(v)},
               .height = hn::GetLane(height),
               .found = hn::GetLane(hn::BitCast(Ints(), flag)) != 0};
#else
    hn::StoreInterleaved4(u, v, height, flag, Floats(), &hits->uv.x);
#endif
}

static_assert(sizeof(CastRay) == 7 * sizeof(float));

// `lane_count` rays one behind the other.
HWY_INLINE RayVectors load_rays(const CastRay* rays) {
    const auto [u, v, du, dv] = load_fours([&](std::size_t lane) HWY_ATTR { return &rays[lane].uv.x; });
    const auto [again, zero_level, z_start, z_end] =
        load_fours([&](std::size_t lane) HWY_ATTR { return &rays[lane].uv_per_height.y; });
    return {u, v, du, dv, zero_level, z_start, z_end};
}

// Bundles in flight: what comes before and after the walks does not branch, so that the processor works at several at once. Four
// are 2 % faster on what lies in its caches and 3 % slower on what does not.
constexpr std::size_t in_flight = 2;

void cast_lanes(const CastGrid& grid, const CastRay* rays, std::size_t vectors, CastHit* hits) {
    const Floats d;
    const Ints di;
    RayVectors ray[in_flight];
    Lanes lanes[in_flight];
    Bundle bundle[in_flight];
    SliceGroup group[in_flight];
    LaneHits hit[in_flight];
    bool together[in_flight];
    for (std::size_t k = 0; k < vectors; ++k) {
        ray[k] = load_rays(rays + k * lane_count);
        set_up(grid, ray[k], lanes[k]);
    }
    for (std::size_t k = 0; k < vectors; ++k) together[k] = make_bundle(grid, lanes[k], bundle[k]);
    for (std::size_t k = 0; k < vectors; ++k)
        if (together[k]) test_slices(grid, bundle[k], 0, group[k]);
    for (std::size_t k = 0; k < vectors; ++k)
        hit[k] = together[k] ? walk_together(grid, lanes[k], bundle[k], group[k]) : walk_alone(grid, lanes[k]);
    for (std::size_t k = 0; k < vectors; ++k) {
        const auto& [begin, gap, slope, bend, met] = hit[k];
        const F zero = hn::Zero(d), far = hn::Set(d, never);
        // The first root from the entry on, which the cell is known to hold, (-slope + sqrt(square)) / (2 bend), without
        // cancellation.
        const F square = hn::Sub(hn::Mul(slope, slope), hn::Mul(hn::Mul(hn::Set(d, 4.0f), bend), gap));
        const F spread = hn::Sqrt(hn::Max(square, zero));
        const FMask rises = hn::Ge(slope, zero);
        const F quotient = hn::Div(hn::IfThenElse(rises, hn::Mul(hn::Set(d, -2.0f), gap), hn::Sub(spread, slope)),
                                   hn::IfThenElse(rises, hn::Add(slope, spread), hn::Add(bend, bend)));
        const F root = hn::IfThenElse(hn::Ge(quotient, zero), quotient, far);
        const F down = hn::Min(hn::Add(begin, hn::IfThenElse(hn::Ge(gap, zero), zero, root)), hn::Load(d, lanes[k].descent_end));
        const F z = hn::IfThenElse(met, hn::Sub(ray[k].z_start, down), ray[k].z_end);
        const F way = hn::Sub(z, ray[k].zero_level);
        // A valid ray that reaches the floor has met it: every field is at least 0.
        const FMask valid = hn::RebindMask(d, hn::Ne(hn::Load(di, lanes[k].valid), hn::Zero(di)));
        const FMask found = hn::Or(met, hn::And(valid, hn::Le(ray[k].z_end, zero)));
        const F flag = hn::BitCast(d, hn::IfThenElseZero(hn::RebindMask(di, found), hn::Set(di, 1)));
        store_hits(hn::MulAdd(way, ray[k].du, ray[k].u), hn::MulAdd(way, ray[k].dv, ray[k].v), z, flag, hits + k * lane_count);
    }
}

void cast(const CastGrid& grid, const CastRay* rays, std::size_t count, CastHit* hits) {
    const std::size_t vectors = count / lane_count;
    for (std::size_t k = 0; k < vectors; k += in_flight)
        cast_lanes(grid, rays + k * lane_count, std::min(in_flight, vectors - k), hits + k * lane_count);
    const std::size_t done = vectors * lane_count;
    if (done == count) return;
    CastRay last_rays[lane_count];
    CastHit last_hits[lane_count];
    for (std::size_t lane = 0; lane < lane_count; ++lane) last_rays[lane] = rays[std::min(done + lane, count - 1)];
    cast_lanes(grid, last_rays, 1, last_hits);
    std::copy(last_hits, last_hits + (count - done), hits + done);
}

}  // namespace HWY_NAMESPACE
}  // namespace relievo
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace relievo {

std::vector<CastTarget> runnable_cast_targets() {
    std::vector<CastTarget> targets;
    [[maybe_unused]] const std::int64_t supported = hwy::SupportedTargets();
#if HWY_TARGETS & HWY_AVX3
    if (supported & HWY_AVX3) targets.push_back({hwy::TargetName(HWY_AVX3), N_AVX3::cast});
#endif
#if HWY_TARGETS & HWY_AVX2
    if (supported & HWY_AVX2) targets.push_back({hwy::TargetName(HWY_AVX2), N_AVX2::cast});
#endif
#if HWY_TARGETS & HWY_SSE4
    if (supported & HWY_SSE4) targets.push_back({hwy::TargetName(HWY_SSE4), N_SSE4::cast});
#endif
    targets.push_back({"scalar", N_SCALAR::cast});
    return targets;
}

}  // namespace relievo
#endif
