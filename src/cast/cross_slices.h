// Each lane of a bundle by itself through a few slices, cell by cell (Amanatides and Woo 1987, "A fast voxel traversal
// algorithm for ray tracing"), all in step. Its next cell does not depend on what the patch said, so that steps overlap.
#if defined(RELIEVO_CAST_CROSS_SLICES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELIEVO_CAST_CROSS_SLICES_H
#undef RELIEVO_CAST_CROSS_SLICES_H
#else
#define RELIEVO_CAST_CROSS_SLICES_H
#endif

#include "cast/bundle_lanes.h"
#include "cast/fours.h"
#include "cast/nearest_hit.h"
#include "cast/slices.h"

HWY_BEFORE_NAMESPACE();
namespace relievo {
namespace HWY_NAMESPACE {

// Slices that are crossed with the first. Another gains nothing, and positions are relative to the first: they lose digits.
constexpr std::size_t most_behind = 2;

// Where each lane, at p_here and z_here now, comes down to `top` between the walls p_from and p_to, as a descent from here; `never`
// where it clears them.
HWY_INLINE F down_to(const BundleLanes& lanes, F p_here, F z_here, float p_from, float p_to, float top) {
    const Floats d;
    const F in = hn::Mul(hn::Sub(p_here, hn::Set(d, p_from)), lanes.back_p);
    const F out = hn::Mul(hn::Sub(p_here, hn::Set(d, p_to)), lanes.back_p);
    const F down = hn::Max(hn::Max(hn::Sub(z_here, hn::Set(d, top + skip_margin)), in), hn::Zero(d));
    return hn::IfThenElse(hn::Le(down, out), down, hn::Set(d, never));
}

// Slices from `slice`, which begins at a_near, to `last`. highest: the largest height of each place in the blocks of `slice`, or
// nullptr: no more is known than its roof. Each lane begins where it is down to the highest.
HWY_INLINE void cross_slices(const CastGrid& grid, const Bundle& bundle, const BundleLanes& lanes, const SliceGroup& group,
                             std::size_t slice, std::size_t last, float a_near, const F* highest, NearestHit& nearest) {
    const Floats d;
    const Ints di;
    const F zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const int u_shift = bundle.along_x ? 0 : block_level, v_shift = bundle.along_x ? block_level : 0;
    const auto behind = static_cast<float>((last - slice) * block_side);
    std::int32_t lowest_row = group.lowest_row[slice], highest_row = group.highest_row[slice];
    for (std::size_t k = slice + 1; k <= last; ++k)
        lowest_row = std::min(lowest_row, group.lowest_row[k]), highest_row = std::max(highest_row, group.highest_row[k]);
    // From the first slice's wall of least p, whichever way lanes go.
    const float first_p = bundle.forward ? 0.0f : -behind;
    const float last_p = bundle.forward ? block_side - 1.0f + behind : block_side - 1.0f;
    const F descent = lanes.descent_at(a_near), z_here = hn::Sub(lanes.z_start, descent);
    const F p_here = lanes.place_p(descent, bundle.forward ? a_near : -a_near - block_side);
    const F q_here = lanes.place_q(descent, static_cast<float>(lowest_row * block_side));
    const F after = hn::Sub(hn::Min(nearest.begin, lanes.descent_end), descent);
    F begin = hn::Set(d, never);
    if (highest != nullptr) {
        alignas(64) float tops[block_cells];
        for (std::size_t c = 0; c < Bundle::vectors; ++c) hn::Store(highest[c], d, tops + c * lane_count);
        for (unsigned w = 0; w < block_side; ++w) {
            // In this column a lane is clear until it is down to the column's highest.
            const float* const top = tops + (w << u_shift);
            const std::size_t next = std::size_t{1} << v_shift;
            const float column_top = std::max(std::max(top[0], top[next]), std::max(top[2 * next], top[3 * next]));
            begin = hn::Min(begin, down_to(lanes, p_here, z_here, static_cast<float>(w) + lanes.near_p,
                                           static_cast<float>(w + 1) - lanes.near_p, column_top));
        }
    } else {
        begin = down_to(lanes, p_here, z_here, block_side * lanes.near_p, block_side * (1 - lanes.near_p), group.roof[slice]);
    }
    float wall = bundle.forward ? block_side : 0.0f;
    for (std::size_t k = slice + 1; k <= last; ++k) {
        const float next = wall + (bundle.forward ? 1.0f : -1.0f) * block_side;
        begin = hn::Min(begin, down_to(lanes, p_here, z_here, wall, next, group.roof[k]));
        wall = next;
    }
    // Lanes that clear every column stay where they are, and out.
    FMask alive = hn::Lt(begin, after);
    begin = hn::IfThenElseZero(alive, begin);
    const F first_u = hn::Set(d, first_p), last_u = hn::Set(d, last_p),
            last_v = hn::Set(d, static_cast<float>((highest_row - lowest_row + 1) * block_side - 1));
    F u = hn::Min(hn::Max(hn::Floor(hn::MulAdd(lanes.speed_p, begin, p_here)), first_u), last_u);
    F v = hn::Min(hn::Max(hn::Floor(hn::MulAdd(lanes.speed_q, begin, q_here)), zero), last_v);
    const F step_u = hn::Set(d, bundle.forward ? 1.0f : -1.0f), step_v = hn::Set(d, bundle.sideways ? 1.0f : -1.0f);
    // A lane that steps out of the window goes on, but is not asked any more.
    const F end_u = bundle.forward ? hn::Add(last_u, one) : hn::Sub(first_u, one),
            end_v = bundle.sideways ? hn::Add(last_v, one) : hn::Neg(one);
    const F enter_p = hn::Mul(lanes.back_p, hn::Set(d, -lanes.near_p)),
            leave_p = hn::Mul(lanes.back_p, hn::Set(d, lanes.near_p - 1));
    const F enter_q = hn::Mul(lanes.back_q, hn::Set(d, -lanes.near_q)),
            leave_q = hn::Mul(lanes.back_q, hn::Set(d, lanes.near_q - 1));
    const I q_first = hn::Set(di, in_period(bundle.block_q + lowest_row, bundle.q_blocks) * block_side - to_bits_as_int),
            p_first = hn::Set(di, group.column[slice] * block_side - to_bits_as_int);
    const I p_floats = hn::Set(di, bundle.along_x ? patch_step : grid.patch_pitch);
    const I q_floats = hn::Set(di, bundle.along_x ? grid.patch_pitch : patch_step);
    const FMask by_x = hn::RebindMask(d, hn::Eq(p_floats, hn::Set(di, patch_step)));
    const float* const patches = grid.patches;
    alignas(64) std::int32_t place[lane_count];
    const volatile std::int32_t* const places = place;  // read from memory: GCC takes the vector apart, which is slower
    NearestHit near = nearest;
    for (;;) {
        const I q = wrapped(hn::Add(q_first, whole_bits(v)), bundle.q_blocks * block_side);
        const I p = wrapped(hn::Add(p_first, whole_bits(u)), bundle.p_blocks * block_side);
        hn::Store(hn::Add(hn::Mul(p, p_floats), hn::Mul(q, q_floats)), di, place);
        const auto [h00, above, right, h11] = load_fours([&](std::size_t lane) HWY_ATTR { return patches + places[lane]; });
        const F h10 = hn::IfThenElse(by_x, right, above), h01 = hn::IfThenElse(by_x, above, right);
        const F x0 = hn::Sub(p_here, u), y0 = hn::Sub(q_here, v);
        const F far_p = hn::MulAdd(x0, lanes.back_p, leave_p), far_q = hn::MulAdd(y0, lanes.back_q, leave_q);
        const F enter = hn::Max(hn::Max(hn::MulAdd(x0, lanes.back_p, enter_p), hn::MulAdd(y0, lanes.back_q, enter_q)), begin);
        const FMask hit = near.put(alive, h00, h10, h01, h11, x0, y0, enter, hn::Min(hn::Min(far_p, far_q), after), descent, z_here,
                                   lanes.speed_p, lanes.speed_q, lanes.speed_pq);
        const FMask through_p = hn::Le(far_p, far_q);
        u = hn::Add(u, hn::IfThenElseZero(through_p, step_u));
        v = hn::Add(v, hn::IfThenElse(through_p, zero, step_v));
        alive = hn::And(hn::AndNot(hit, alive), hn::And(hn::Ne(u, end_u), hn::Ne(v, end_v)));
        if (hn::AllFalse(d, alive)) break;
    }
    nearest = near;
}

}  // namespace HWY_NAMESPACE
}  // namespace relievo
HWY_AFTER_NAMESPACE();

#endif  // per target
