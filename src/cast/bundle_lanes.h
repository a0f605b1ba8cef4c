// The lanes of a bundle by its axes.
#if defined(RELIEVO_CAST_BUNDLE_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELIEVO_CAST_BUNDLE_LANES_H
#undef RELIEVO_CAST_BUNDLE_LANES_H
#else
#define RELIEVO_CAST_BUNDLE_LANES_H
#endif

#include "cast/bundle.h"

HWY_BEFORE_NAMESPACE();
namespace relievo {
namespace HWY_NAMESPACE {

struct BundleLanes {
    F speed_p, speed_q, speed_pq;  // speed_pq: their product
    F rest_p, rest_q;              // what the float speeds lack
    F back_p, back_q;              // -1 / speed
    F pace;                        // descent per cell along p
    F cells_p, cells_q, inside_p, inside_q;
    F a_start, z_start, descent_end;
    float near_p, near_q;  // which wall of a cell, 0 or 1, lanes enter by

    // The lanes where they cross the wall at `a`, or start, or end. What follows in a slice is relative to that.
    HWY_INLINE F descent_at(float a) const {
        const Floats d;
        return hn::Min(hn::Max(hn::Mul(hn::Sub(hn::Set(d, a), a_start), pace), hn::Zero(d)), descent_end);
    }
    // Their places there, from a wall.
    HWY_INLINE F place_p(F descent, float wall) const {
        return precise_offset(speed_p, rest_p, descent, hn::Sub(hn::Set(Floats(), wall), cells_p), inside_p);
    }
    HWY_INLINE F place_q(F descent, float wall) const {
        return precise_offset(speed_q, rest_q, descent, hn::Sub(hn::Set(Floats(), wall), cells_q), inside_q);
    }
};

HWY_INLINE BundleLanes bundle_lanes(const Lanes& in, const Bundle& bundle) {
    const Floats d;
    const LaneAxis& p = bundle.along_x ? in.x : in.y;
    const LaneAxis& q = bundle.along_x ? in.y : in.x;
    const F along = hn::Add(bundle.cells_p, bundle.inside_p);
    BundleLanes lanes;
    lanes.speed_p = hn::Load(d, p.speed), lanes.speed_q = hn::Load(d, q.speed);
    lanes.speed_pq = hn::Mul(lanes.speed_p, lanes.speed_q);
    lanes.rest_p = hn::Load(d, p.rest), lanes.rest_q = hn::Load(d, q.rest);
    lanes.back_p = hn::Neg(hn::Load(d, p.inverse));
    // A lane that does not move sideways has either sign: it takes that of the others.
    lanes.back_q = hn::CopySign(hn::Load(d, q.inverse), hn::Set(d, bundle.sideways ? -1.0f : 1.0f));
    lanes.pace = hn::Abs(lanes.back_p);
    lanes.cells_p = bundle.cells_p, lanes.cells_q = bundle.cells_q, lanes.inside_p = bundle.inside_p,
    lanes.inside_q = bundle.inside_q;
    lanes.a_start = bundle.forward ? along : hn::Neg(along);
    lanes.z_start = hn::Load(d, in.z_start), lanes.descent_end = hn::Load(d, in.descent_end);
    lanes.near_p = bundle.forward ? 0 : 1, lanes.near_q = bundle.sideways ? 0 : 1;
    return lanes;
}

}  // namespace HWY_NAMESPACE
}  // namespace relievo
HWY_AFTER_NAMESPACE();

#endif  // per target
