// The nearest cell that each lane hits, of those put to it so far.
#if defined(RELIEVO_CAST_NEAREST_HIT_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELIEVO_CAST_NEAREST_HIT_H
#undef RELIEVO_CAST_NEAREST_HIT_H
#else
#define RELIEVO_CAST_NEAREST_HIT_H
#endif

#include "cast/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace relievo {
namespace HWY_NAMESPACE {

struct NearestHit {
    F begin, gap, slope, bend;

    HWY_INLINE NearestHit()
        : begin(hn::Set(Floats(), never)), gap(hn::Zero(Floats())), slope(hn::Set(Floats(), 1.0f)), bend(hn::Zero(Floats())) {}
    HWY_INLINE FMask found() const { return hn::Lt(begin, hn::Set(Floats(), never)); }

    // Puts the patch of four corner heights to all lanes, which cross its cell from enter to exit, both counted from `descent`; at
    // `descent` they are at height z and at x, y relative to the cell. Which cell is hit is decided by signs. True for lanes that
    // hit this one; only those `asked` remember it.
    HWY_INLINE FMask put(FMask asked, F h00, F h10, F h01, F h11, F x0, F y0, F enter, F exit, F descent, F z, F speed_x, F speed_y,
                         F speed_xy) {
        const Floats d;
        const F zero = hn::Zero(d), one = hn::Set(d, 1.0f);
        const F b = hn::Sub(h10, h00), c = hn::Sub(h01, h00), twist = hn::Sub(hn::Sub(h11, h01), b);
        const F length = hn::Sub(exit, enter);
        const F x = hn::MulAdd(speed_x, enter, x0), y = hn::MulAdd(speed_y, enter, y0);
        const F leans = hn::MulAdd(twist, x, c);
        const F here = hn::MulAdd(leans, y, hn::MulAdd(b, x, hn::Add(enter, hn::Sub(h00, z))));
        const F rise = hn::MulAdd(hn::MulAdd(twist, y, b), speed_x, hn::MulAdd(leans, speed_y, one));
        const F curve = hn::Mul(twist, speed_xy);
        const F last = hn::MulAdd(length, hn::MulAdd(length, curve, rise), here);
        // Below at the entry or at the exit of a cell that is crossed.
        FMask hit = hn::Ge(hn::Min(length, hn::Max(here, last)), zero);
        // Above at both, yet below between: a gap that rises and falls, with real roots.
        const F last_rise = hn::MulAdd(hn::Add(curve, curve), length, rise);
        const FMask dome = hn::Gt(hn::Min(length, hn::Min(rise, hn::Neg(last_rise))), zero);
        hit = hn::Or(hit, hn::And(dome, hn::Ge(hn::Mul(rise, rise), hn::Mul(hn::Mul(hn::Set(d, 4.0f), curve), here))));
        // Of cells hit the nearest, whatever their order. Compared last, so that cells do not wait for each other.
        const F at = hn::Add(descent, enter);
        const FMask nearer = hn::And(hn::And(hit, asked), hn::Lt(at, begin));
        begin = hn::IfThenElse(nearer, at, begin);
        gap = hn::IfThenElse(nearer, here, gap);
        slope = hn::IfThenElse(nearer, rise, slope);
        bend = hn::IfThenElse(nearer, curve, bend);
        return hit;
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace relievo
HWY_AFTER_NAMESPACE();

#endif  // per target
