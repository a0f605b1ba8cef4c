// The rule of relaxed_cone.cpp for the edges of a cell, in lanes. Included once for every kind of machine.
#include "maps/cone_search_lanes.h"

namespace relievo::cone_search::RELIEVO_MACHINE {

struct RelaxedRule : RelaxedCells {
    // The part of an edge, [low, high] of [0,1], where a function that is linear from f0 to f1 is negative.
    struct Part {
        Lanes low, high;
    };
    static Part negative(Lanes f0, Lanes f1) {
        const LaneMask first = f0 < 0.0f;
        const LaneMask last = f1 < 0.0f;
        const Lanes root = f0 / (f0 - f1);  // used only where the signs differ
        Part part;
        part.low = first ? Lanes{} : root;
        part.high = last ? 1.0f + Lanes{} : root;
        return part;
    }

    // X Hx + Y Hy, the radial derivative times the distance, less a margin for rounding.
    static Lanes fall(Lanes x, Lanes hx, Lanes y, Lanes hy) {
        return x * hx + y * hy - 0x1p-20f * (x * magnitude(hx) + y * magnitude(hy));
    }

    // The cell turned so that each texel looks into the quadrant of positive x and y: every cell lies wholly in one closed quadrant of every
    // texel centre. h00 is then the corner nearest to the texel, heights are relative to it.
    struct Turned {
        Lanes h00, h10, h01, h11;
        Lanes x, y;
    };
    static Turned turned(const Corners& c, const Seen& seen) {
        const LaneMask right = seen.dx >= 0.0f;
        const LaneMask up = seen.dy >= 0.0f;
        const Lanes none{};
        const Lanes low_near = right ? c.h00 + none : c.h10 + none;
        const Lanes low_far = right ? c.h10 + none : c.h00 + none;
        const Lanes high_near = right ? c.h01 + none : c.h11 + none;
        const Lanes high_far = right ? c.h11 + none : c.h01 + none;
        return {(up ? low_near : high_near) - seen.apex, (up ? low_far : high_far) - seen.apex, (up ? high_near : low_near) - seen.apex,
                (up ? high_far : low_far) - seen.apex,   most(seen.dx, -1.0f - seen.dx),        most(seen.dy, -1.0f - seen.dy)};
    }

    static LaneMask limit(const Corners& corners, const Seen& seen, const Metric& m, LaneMask within, Lanes& q) {
        const Turned c = turned(corners, seen);
        const Lanes bx0 = c.h10 - c.h00;
        const Lanes bx1 = c.h11 - c.h01;
        const Lanes by0 = c.h01 - c.h00;
        const Lanes by1 = c.h11 - c.h10;
        const Lanes corner = fall(c.x, bx0, c.y, by0);
        const Lanes x2 = c.x * c.x * m.u2;
        const Lanes y2 = c.y * c.y * m.v2;
        edge(corner, fall(c.x, bx1, c.y + 1.0f, by0), c.h00, c.h01, x2, c.y, m.v2, q);
        edge(corner, fall(c.x + 1.0f, bx0, c.y, by1), c.h00, c.h10, y2, c.x, m.u2, q);
        return within & may_bind_inside(c);
    }

    // The near edge from height h0 to h1, where the surface behind it falls by f0 to f1.
    static void edge(Lanes f0, Lanes f1, Lanes h0, Lanes h1, Lanes e2, Lanes along, float s2, Lanes& q) {
        const Lanes highest = most(h0, h1);
        const LaneMask steeper = ((f0 < 0.0f) | (f1 < 0.0f)) & (highest > 0.0f) & (e2 + along * along * s2 < q * slack * highest * highest);
        if (!any(steeper)) return;
        const Part part = negative(f0, f1);
        const Lanes v = steepest(h0, h1 - h0, e2, along, s2, part.low, part.high);
        q = steeper ? least(q, squared_ratio(h0, h1, e2, along, s2, v)) : q;
    }

    // d < 0, and the radial derivative, bilinear like H itself, has both signs. With a margin for rounding; inside() decides.
    static LaneMask may_bind_inside(const Turned& c) {
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
