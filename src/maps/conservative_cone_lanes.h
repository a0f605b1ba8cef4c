// The rule of conservative_cone.cpp for the edges of a cell, in lanes. Included once for every kind of machine.
#include "maps/cone_search_lanes.h"

namespace relievo::cone_search::RELIEVO_MACHINE {

struct ConservativeRule : ConservativeCells {
    static Lanes edges(const CellLanes& c, const Metric& m) {
        const Lanes x2 = c.x * c.x * m.u2;
        const Lanes y2 = c.y * c.y * m.v2;
        const Lanes v = steepest(c.h00, c.h01 - c.h00, x2, c.y, m.v2, Lanes{}, 1.0f + Lanes{});
        const Lanes u = steepest(c.h00, c.h10 - c.h00, y2, c.x, m.u2, Lanes{}, 1.0f + Lanes{});
        return least(squared_ratio(c.h00, c.h01, x2, c.y, m.v2, v), squared_ratio(c.h00, c.h10, y2, c.x, m.u2, u));
    }

    // d < 0, and the slope along the ray grows at the near corner and shrinks at the far one: X Hx + Y Hy - (H - h_x) = d X Y - C
    // changes its sign between them. With a margin for rounding; inside() decides.
    static LaneMask may_bind_inside(const CellLanes& c) {
        const Lanes bx0 = c.h10 - c.h00;
        const Lanes bx1 = c.h11 - c.h01;
        const Lanes by0 = c.h01 - c.h00;
        const Lanes by1 = c.h11 - c.h10;
        const Lanes far_x = c.x + 1.0f;
        const Lanes far_y = c.y + 1.0f;
        const Lanes margin = 0x1p-20f * (far_x * (magnitude(bx0) + magnitude(bx1)) + far_y * (magnitude(by0) + magnitude(by1)) + magnitude(c.h00));
        return (by1 - by0 <= 0x1p-20f * (magnitude(by0) + magnitude(by1))) & (c.x * bx0 + c.y * by0 - c.h00 >= -margin) &
               (far_x * bx1 + far_y * by1 - c.h11 <= margin);
    }
};

inline void search_conservative(const Rows& rows) { search_rows<ConservativeRule>(rows); }

}  // namespace relievo::cone_search::RELIEVO_MACHINE
