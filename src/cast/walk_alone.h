// Every lane by itself through the pyramid of maxima (Tevs, Ihrke and Seidel 2008), all in step: one node of each lane a turn.
#if defined(RELIEVO_CAST_WALK_ALONE_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELIEVO_CAST_WALK_ALONE_H
#undef RELIEVO_CAST_WALK_ALONE_H
#else
#define RELIEVO_CAST_WALK_ALONE_H
#endif

#include "cast/fours.h"

HWY_BEFORE_NAMESPACE();
namespace relievo {
namespace HWY_NAMESPACE {

HWY_INLINE LaneHits walk_alone(const CastGrid& grid, const Lanes& lanes) {
    const Floats d;
    const Ints di;
    const F zero = hn::Zero(d);
    const F one = hn::Set(d, 1.0f);
    const I one_i = hn::Set(di, 1);
    const F start_x = hn::Load(d, lanes.x.start), start_y = hn::Load(d, lanes.y.start);
    const F speed_x = hn::Load(d, lanes.x.speed), speed_y = hn::Load(d, lanes.y.speed);
    const F inverse_x = hn::Load(d, lanes.x.inverse), inverse_y = hn::Load(d, lanes.y.inverse);
    const F z_start = hn::Load(d, lanes.z_start);
    const F descent_end = hn::Load(d, lanes.descent_end);
    // Nodes much longer than the ray's whole way hardly ever lie below it: begin, and stay, where a node is no longer than about an
    // eighth of the way, by the exponent of the float.
    const F texels = hn::Mul(hn::Add(hn::Abs(speed_x), hn::Abs(speed_y)), hn::Mul(descent_end, hn::Set(d, 0.125f)));
    const I top =
        hn::Max(hn::Min(hn::Sub(hn::ShiftRight<23>(hn::BitCast(di, texels)), hn::Set(di, 126)), hn::Set(di, grid.levels - 1)),
                hn::Zero(di));
    const IMask right = hn::RebindMask(di, hn::Ge(speed_x, zero));
    const IMask up = hn::RebindMask(di, hn::Ge(speed_y, zero));
    const I width = hn::Set(di, grid.width), height = hn::Set(di, grid.height);
    const I last_x = hn::Sub(width, one_i), last_y = hn::Sub(height, one_i);
    const I stack = hn::Set(di, grid.stack), pitch = hn::Set(di, grid.node_pitch);
    const F margin = hn::Set(d, skip_margin);

    I wrapped_x = hn::Load(di, lanes.x.cell), wrapped_y = hn::Load(di, lanes.y.cell);
    I base_x = hn::Sub(hn::Zero(di), wrapped_x),
      base_y = hn::Sub(hn::Zero(di), wrapped_y);  // wrapped + base: relative to the first cell
    I level = top;
    F descent = zero;
    F result = descent_end;
    FMask found = hn::Lt(zero, zero);
    FMask walking = hn::Not(found);
    constexpr std::size_t n = lane_count;

    for (;;) {
        // The node of this level that holds the cell, and its walls.
        const I node_x = hn::Shr(wrapped_x, level), node_y = hn::Shr(wrapped_y, level);
        const I extent = hn::Shl(one_i, level);
        const I low_x = hn::Shl(node_x, level), low_y = hn::Shl(node_y, level);
        const I high_x = hn::Min(hn::Add(low_x, extent), width), high_y = hn::Min(hn::Add(low_y, extent), height);
        const I index = hn::Add(hn::Mul(hn::Add(node_y, hn::Sub(stack, hn::Shr(stack, level))), pitch), node_x);
        const I wall_x = hn::IfThenElse(right, high_x, low_x), wall_y = hn::IfThenElse(up, high_y, low_y);
        const F exit_x = hn::Mul(hn::Sub(hn::ConvertTo(d, hn::Add(wall_x, base_x)), start_x), inverse_x);
        const F exit_y = hn::Mul(hn::Sub(hn::ConvertTo(d, hn::Add(wall_y, base_y)), start_y), inverse_y);
        const F leave = hn::Max(hn::Min(exit_x, exit_y), descent);
        const F highest = node_top(grid.nodes, index);

        FMask skip = hn::Gt(hn::Sub(hn::Sub(z_start, hn::Min(leave, descent_end)), margin), highest);
        const FMask in_cell = hn::RebindMask(d, hn::Eq(level, hn::Zero(di)));
        FMask waits = hn::And(hn::AndNot(skip, in_cell), walking);
        const std::size_t waiting = hn::CountTrue(d, waits);
        if (waiting != 0 && (waiting * 4 >= n || hn::AllFalse(d, hn::AndNot(waits, walking)))) {
            alignas(64) std::int32_t place[lane_count];
            hn::Store(hn::IfThenElseZero(hn::RebindMask(di, waits), hn::Add(hn::Mul(wrapped_y, hn::Set(di, grid.patch_pitch)),
                                                                            hn::Mul(wrapped_x, hn::Set(di, patch_step)))),
                      di, place);
            const float* const patches = grid.patches;
            const auto [h00, h01, h10, h11] = load_fours([&](std::size_t lane) HWY_ATTR { return patches + place[lane]; });
            const F b = hn::Sub(h10, h00), c = hn::Sub(h01, h00), twist = hn::Sub(hn::Sub(h11, h01), b);
            const F x =
                precise_offset(speed_x, hn::Load(d, lanes.x.rest), descent, hn::ConvertTo(d, hn::Add(wrapped_x, base_x)), start_x);
            const F y =
                precise_offset(speed_y, hn::Load(d, lanes.y.rest), descent, hn::ConvertTo(d, hn::Add(wrapped_y, base_y)), start_y);
            const F near_x = hn::IfThenElse(hn::RebindMask(d, right), zero, one),
                    near_y = hn::IfThenElse(hn::RebindMask(d, up), zero, one);
            const F enter =
                hn::Max(hn::Max(hn::Mul(hn::Sub(near_x, x), inverse_x), hn::Mul(hn::Sub(near_y, y), inverse_y)), hn::Neg(descent));
            const F exit = hn::Min(
                hn::Min(hn::Mul(hn::Sub(hn::Sub(one, near_x), x), inverse_x), hn::Mul(hn::Sub(hn::Sub(one, near_y), y), inverse_y)),
                hn::Sub(descent_end, descent));
            const F ex = hn::Min(hn::Max(hn::MulAdd(speed_x, enter, x), zero), one);
            const F ey = hn::Min(hn::Max(hn::MulAdd(speed_y, enter, y), zero), one);
            const F begin = hn::Add(descent, enter);
            const F length = hn::Sub(exit, enter);
            // Gap (field minus ray) from the entry on: gap + s (slope + s bend); its first root in [0, length].
            const F gap = hn::Add(hn::Add(hn::Sub(h00, z_start), begin),
                                  hn::MulAdd(hn::Mul(twist, ex), ey, hn::MulAdd(b, ex, hn::Mul(c, ey))));
            const F slope = hn::Add(
                hn::MulAdd(twist, hn::MulAdd(ex, speed_y, hn::Mul(ey, speed_x)), hn::MulAdd(b, speed_x, hn::Mul(c, speed_y))), one);
            const F bend = hn::Mul(twist, hn::Mul(speed_x, speed_y));
            const F square = hn::Sub(hn::Mul(slope, slope), hn::Mul(hn::Mul(hn::Set(d, 4.0f), bend), gap));
            const auto [root_1, root_2] = roots_of(gap, slope, bend, square);
            const auto inside = [&](F root) { return hn::And(hn::Ge(root, zero), hn::Le(root, length)); };
            const F far = hn::Set(d, never);
            const F root = hn::Min(hn::IfThenElse(inside(root_1), root_1, far), hn::IfThenElse(inside(root_2), root_2, far));
            const FMask below = hn::Ge(gap, zero);
            const FMask crosses = hn::Or(below, hn::And(hn::Ge(square, zero), hn::Lt(root, far)));
            const FMask hit = hn::And(hn::And(waits, crosses), hn::Le(enter, exit));
            result = hn::IfThenElse(hit, hn::Add(begin, hn::IfThenElse(below, zero, root)), result);
            found = hn::Or(found, hit);
            walking = hn::AndNot(hit, walking);
            skip = hn::Or(skip, waits);
            waits = hn::Lt(zero, zero);
            if (hn::AllFalse(d, walking)) break;
        }
        // Where a node is opened: the ray comes down to its top there; walls already passed are not taken back.
        const FMask moves = hn::AndNot(waits, walking);
        const F down = hn::Max(hn::Sub(hn::Sub(z_start, highest), margin), descent);
        const F next = hn::IfThenElse(skip, leave, down);
        descent = hn::IfThenElse(moves, next, descent);
        const IMask moves_i = hn::RebindMask(di, moves);
        const IMask skip_i = hn::RebindMask(di, skip);
        const F reached = hn::Min(descent, descent_end);
        const I here_x = hn::Sub(hn::ConvertTo(di, hn::Floor(hn::MulAdd(speed_x, reached, start_x))), base_x);
        const I here_y = hn::Sub(hn::ConvertTo(di, hn::Floor(hn::MulAdd(speed_y, reached, start_y))), base_y);
        I moved_x = hn::Min(hn::Max(here_x, hn::IfThenElse(right, wrapped_x, low_x)),
                            hn::IfThenElse(right, hn::Sub(high_x, one_i), wrapped_x));
        I moved_y =
            hn::Min(hn::Max(here_y, hn::IfThenElse(up, wrapped_y, low_y)), hn::IfThenElse(up, hn::Sub(high_y, one_i), wrapped_y));
        const IMask through_x = hn::RebindMask(di, hn::Le(exit_x, exit_y));
        moved_x = hn::IfThenElse(hn::And(skip_i, through_x), hn::IfThenElse(right, high_x, hn::Sub(low_x, one_i)), moved_x);
        moved_y = hn::IfThenElse(hn::AndNot(through_x, skip_i), hn::IfThenElse(up, high_y, hn::Sub(low_y, one_i)), moved_y);
        // Up only on leaving the parent, which was opened for a reason. Bits that differ above the parent's: another parent.
        const I differs = hn::Shr(hn::Or(hn::Xor(moved_x, wrapped_x), hn::Xor(moved_y, wrapped_y)), hn::Add(level, one_i));
        // Over the period's end.
        const IMask past_x = hn::Gt(moved_x, last_x), before_x = hn::Lt(moved_x, hn::Zero(di));
        const IMask past_y = hn::Gt(moved_y, last_y), before_y = hn::Lt(moved_y, hn::Zero(di));
        const IMask around = hn::Or(hn::Or(past_x, before_x), hn::Or(past_y, before_y));
        const I shift_x = hn::Sub(hn::IfThenElseZero(before_x, width), hn::IfThenElseZero(past_x, width));
        const I shift_y = hn::Sub(hn::IfThenElseZero(before_y, height), hn::IfThenElseZero(past_y, height));
        wrapped_x = hn::IfThenElse(moves_i, hn::Add(moved_x, shift_x), wrapped_x);
        wrapped_y = hn::IfThenElse(moves_i, hn::Add(moved_y, shift_y), wrapped_y);
        base_x = hn::IfThenElse(moves_i, hn::Sub(base_x, shift_x), base_x);
        base_y = hn::IfThenElse(moves_i, hn::Sub(base_y, shift_y), base_y);
        const IMask rises = hn::And(hn::Or(hn::Ne(differs, hn::Zero(di)), around), hn::Lt(level, top));
        const I skipped = hn::IfThenElse(rises, hn::Add(level, one_i), level);
        level = hn::IfThenElse(moves_i, hn::IfThenElse(skip_i, skipped, hn::Sub(level, one_i)), level);
        walking = hn::AndNot(hn::And(moves, hn::Ge(descent, descent_end)), walking);
        if (hn::AllFalse(d, walking)) break;
    }
    return {result, zero, one, zero, found};
}

}  // namespace HWY_NAMESPACE
}  // namespace relievo
HWY_AFTER_NAMESPACE();

#endif  // per target
