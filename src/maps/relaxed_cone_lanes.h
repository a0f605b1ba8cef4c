// The rule of relaxed_cone.cpp for the edges of a cell, in lanes. Included once for every kind of machine.
#include "maps/cone_search_lanes.h"

namespace relievo::cone_search::RELIEVO_MACHINE {

struct RelaxedRule : RelaxedCells {
    // The part of an edge, [low, high] of [0,1], where a function that is linear from f0 to f1 is negative.
    struct Part {
        Lanes low, high;
        LaneMask some;
    };
    static Part negative(Lanes f0, Lanes f1) {
        const LaneMask first = f0 < 0.0f;
        const LaneMask last = f1 < 0.0f;
        const Lanes root = f0 / (f0 - f1);  // used only where the signs differ
        Part part;
        part.low = first ? Lanes{} : root;
        part.high = last ? 1.0f + Lanes{} : root;
        part.some = first | last;
        return part;
    }

    // X Hx + Y Hy, the radial derivative times the distance, less a margin for rounding.
    static Lanes fall(Lanes x, Lanes hx, Lanes y, Lanes hy) {
        return x * hx + y * hy - 0x1p-20f * (x * magnitude(hx) + y * magnitude(hy));
    }

    static Lanes edges(const CellLanes& c, const Metric& m) {
        const Lanes bx0 = c.h10 - c.h00;
        const Lanes bx1 = c.h11 - c.h01;
        const Lanes by0 = c.h01 - c.h00;
        const Lanes by1 = c.h11 - c.h10;
        const Lanes corner = fall(c.x, bx0, c.y, by0);
        const Part left = negative(corner, fall(c.x, bx1, c.y + 1.0f, by0));
        const Part below = negative(corner, fall(c.x + 1.0f, bx0, c.y, by1));
        const Lanes x2 = c.x * c.x * m.u2;
        const Lanes y2 = c.y * c.y * m.v2;
        const Lanes v = steepest(c.h00, by0, x2, c.y, m.v2, left.low, left.high);
        const Lanes u = steepest(c.h00, bx0, y2, c.x, m.u2, below.low, below.high);
        const Lanes none = no_limit + Lanes{};
        return least(left.some ? squared_ratio(c.h00, c.h01, x2, c.y, m.v2, v) : none,
                     below.some ? squared_ratio(c.h00, c.h10, y2, c.x, m.u2, u) : none);
    }

    // d < 0, and the radial derivative, bilinear like H itself, has both signs. With a margin for rounding; inside() decides.
    static LaneMask may_bind_inside(const CellLanes& c) {
        const Lanes bx0 = c.h10 - c.h00;
        const Lanes bx1 = c.h11 - c.h01;
        const Lanes by0 = c.h01 - c.h00;
        const Lanes by1 = c.h11 - c.h10;
        const Lanes far_x = c.x + 1.0f;
        const Lanes far_y = c.y + 1.0f;
        const Lanes g00 = c.x * bx0 + c.y * by0;
        const Lanes g10 = far_x * bx0 + c.y * by1;
        const Lanes g01 = c.x * bx1 + far_y * by0;
        const Lanes g11 = far_x * bx1 + far_y * by1;
        const Lanes margin = 0x1p-20f * (far_x * (magnitude(bx0) + magnitude(bx1)) + far_y * (magnitude(by0) + magnitude(by1)));
        return (by1 - by0 <= 0x1p-20f * (magnitude(by0) + magnitude(by1))) & (least(least(g00, g10), least(g01, g11)) < margin) &
               (most(most(g00, g10), most(g01, g11)) > -margin);
    }
};

inline void search_relaxed(const Rows& rows) { search_rows<RelaxedRule>(rows); }

}  // namespace relievo::cone_search::RELIEVO_MACHINE
