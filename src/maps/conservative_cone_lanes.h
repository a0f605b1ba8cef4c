// The rule of conservative_cone.cpp for the edges of a cell, in lanes. Included once for every kind of machine.
#include "maps/cone_search_lanes.h"

namespace relievo::cone_search::RELIEVO_MACHINE {

struct ConservativeRule : ConservativeCells {
    // Every corner and every edge is its own cell's once: the first corner and the two edges from it are this cell's. Without divisions
    // as long as nothing gets narrower.
    static LaneMask limit(const Corners& c, const Seen& seen, const Metric& m, LaneMask within, Lanes& q) {
        const Lanes rise = c.h00 - seen.apex;
        const Lanes x2 = seen.dx * seen.dx * m.u2;
        const Lanes y2 = seen.dy * seen.dy * m.v2;
        const LaneMask corner = (x2 + y2 < q * rise * rise) & (rise > 0.0f);
        if (any(corner)) q = corner ? (x2 + y2) / (rise * rise) : q;
        edge(rise, c.h01 - c.h00, x2, seen.dy, m.v2, q);
        edge(rise, c.h10 - c.h00, y2, seen.dx, m.u2, q);
        const LaneMask inside = within & may_touch_inside(c, seen, m, q);
        return any(inside) ? inside & may_bind_inside(c, seen, rise) : inside;
    }

    // Along the edge from height `rise` with slope b a texel, at squared distance e2, the steepest point lies between the ends where the
    // derivative, b e2 - (rise - b along) s2 (along + v), falls from + to -; the squared slope there is a^2 / e2 + b^2 / s2.
    static void edge(Lanes rise, float b, Lanes e2, Lanes along, float s2, Lanes& q) {
        const Lanes at_foot = rise - b * along;
        const Lanes first = b * e2 - at_foot * s2 * along;
        const Lanes slope2 = at_foot * at_foot * s2 + b * b * e2;
        const LaneMask steeper = (first > 0.0f) & (first < at_foot * s2) & (e2 * s2 < q * slope2);
        if (any(steeper)) q = steeper ? e2 * s2 / slope2 : q;
    }

    // Where a cone touches the surface inside a cell, the gradient points away from the texel and is as steep as the cone: some
    // gradient of the cell has to rise outward along both axes, and to be steeper than the cone that is there already.
    static LaneMask may_touch_inside(const Corners& c, const Seen& seen, const Metric& m, Lanes q) {
        const float bx0 = c.h10 - c.h00;
        const float bx1 = c.h11 - c.h01;
        const float by0 = c.h01 - c.h00;
        const float by1 = c.h11 - c.h10;
        const Lanes none{};
        const Lanes gx = seen.dx >= 0.0f ? std::max(bx0, bx1) + none : std::max(-bx0, -bx1) + none;
        const Lanes gy = seen.dy >= 0.0f ? std::max(by0, by1) + none : std::max(-by0, -by1) + none;
        return (gx > 0.0f) & (gy > 0.0f) & (q * slack * (gx * gx * m.v2 + gy * gy * m.u2) >= m.u2 * m.v2);
    }

    // Where twist X Y < 0 in the texel's quadrant and the slope along the ray is steepest inside: X Hx + Y Hy - (H - h_x) = twist X Y - C
    // changes its sign. With a margin for rounding; inside() decides.
    static LaneMask may_bind_inside(const Corners& c, const Seen& seen, Lanes rise) {
        const float bx = c.h10 - c.h00;
        const float by = c.h01 - c.h00;
        const float twist = static_cast<float>(static_cast<double>(c.h11) - c.h10 - c.h01 + c.h00);
        const Lanes product = seen.dx * seen.dy;
        const Lanes at_apex = rise - seen.dx * bx - seen.dy * by + twist * product;
        const Lanes t00 = twist * product - at_apex;
        const Lanes t10 = t00 + twist * seen.dy;
        const Lanes t01 = t00 + twist * seen.dx;
        const Lanes t11 = t10 + twist * (seen.dx + 1.0f);
        const Lanes margin = 0x1p-20f * ((magnitude(seen.dx) + 1.0f) * (std::abs(bx) + std::abs(twist)) +
                                         (magnitude(seen.dy) + 1.0f) * (std::abs(by) + std::abs(twist)) + magnitude(rise) +
                                         std::abs(twist) * (magnitude(product) + 1.0f));
        return (twist * (seen.dx + 0.5f) * (seen.dy + 0.5f) < 0.0f) & (most(most(t00, t10), most(t01, t11)) >= -margin) &
               (least(least(t00, t10), least(t01, t11)) <= margin);
    }
};

inline void search_conservative(const Rows& rows) { search_rows<ConservativeRule>(rows); }

}  // namespace relievo::cone_search::RELIEVO_MACHINE
