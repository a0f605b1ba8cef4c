// The caster's inner loop, compiled once per instruction set (Highway's foreach_target includes this file again for each) and
// chosen at run time. docs/concepts/cpu_caster.md says how it works and why it cannot miss.
#include "cast/cast_grid.h"

#include <cstddef>

// SSSE3 alone gains nothing over plain code here; fewer copies compile faster.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS HWY_SSSE3
#endif
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "cast/cast_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "cast/lanes.h"
#include "cast/walk_alone.h"
#include "cast/walk_together.h"

HWY_BEFORE_NAMESPACE();
namespace relievo {
namespace HWY_NAMESPACE {

static_assert(sizeof(CastHit) == 4 * sizeof(float) && offsetof(CastHit, height) == 8 && offsetof(CastHit, found) == 12);

void cast_lanes(const CastGrid& grid, const CastRay* rays, CastHit* hits) {
    const Floats d;
    const Ints di;
    Lanes lanes;
    const RayVectors ray = load_rays(rays);
    set_up(grid, ray, lanes);
    Bundle bundle;
    const LaneHits hit = make_bundle(grid, lanes, bundle) ? walk_together(grid, lanes, bundle) : walk_alone(grid, lanes);
    const F z = hn::IfThenElse(hit.found, hn::Sub(ray.z_start, hit.descent), ray.z_end);
    const F way = hn::Sub(z, ray.zero_level);
    // A valid ray that reaches the floor has met it: every field is at least 0.
    const FMask valid = hn::RebindMask(d, hn::Ne(hn::Load(di, lanes.valid), hn::Zero(di)));
    const FMask found = hn::Or(hit.found, hn::And(valid, hn::Le(ray.z_end, hn::Zero(d))));
    const I flag = hn::IfThenElseZero(hn::RebindMask(di, found), hn::Set(di, 1));
    alignas(64) float u[lane_count], v[lane_count], height[lane_count];
    alignas(64) std::int32_t flags[lane_count];
    hn::Store(hn::MulAdd(way, ray.du, ray.u), d, u), hn::Store(hn::MulAdd(way, ray.dv, ray.v), d, v);
    hn::Store(z, d, height), hn::Store(flag, di, flags);
    for (std::size_t k = 0; k < lane_count; ++k) hits[k] = {.uv = {u[k], v[k]}, .height = height[k], .found = flags[k] != 0};
}

void cast(const CastGrid& grid, const CastRay* rays, std::size_t count, CastHit* hits) {
    std::size_t k = 0;
    for (; k + lane_count <= count; k += lane_count) cast_lanes(grid, rays + k, hits + k);
    if (k == count) return;
    CastRay last_rays[lane_count];
    CastHit last_hits[lane_count];
    for (std::size_t lane = 0; lane < lane_count; ++lane) last_rays[lane] = rays[k + lane < count ? k + lane : count - 1];
    cast_lanes(grid, last_rays, last_hits);
    for (std::size_t lane = 0; k + lane < count; ++lane) hits[k + lane] = last_hits[lane];
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
