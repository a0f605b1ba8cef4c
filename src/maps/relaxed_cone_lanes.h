// The rule of relaxed_cone.cpp for the edges of a cell, in lanes. Included once for every kind of machine.
#include "maps/cone_search_lanes.h"

namespace relievo::cone_search::RELIEVO_MACHINE {

struct RelaxedRule : RelaxedCells {
    static constexpr int ring = 3;

    static void texel(Lanes, Lanes, Lanes&) {}  // where nothing falls behind it, it limits nothing

    // Whether cells whose points lie [x0, x1] by [y0, y1] texels from some texels may fall, seen from them.
    static LaneMask falls(const Corners& c, Lanes x0, Lanes x1, Lanes y0, Lanes y1) {
        const auto least_product = [](Lanes a0, Lanes a1, Lanes b0, Lanes b1) {
            const Lanes low = least(b0, b1);
            const Lanes high = most(b0, b1);
            return least(least(a0 * low, a0 * high), least(a1 * low, a1 * high));
        };
        const Lanes along_x = least_product(x0, x1, c.h10 - c.h00, c.h11 - c.h01);
        const Lanes along_y = least_product(y0, y1, c.h01 - c.h00, c.h11 - c.h10);
        return along_x + along_y < 0x1p-20f * (magnitude(along_x) + magnitude(along_y));
    }

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

    // The cell turned so that each texel looks into the quadrant of positive x and y: every cell lies wholly in one closed quadrant
    // of every texel centre. h00 is then the corner nearest to the texel, heights are relative to it.
    struct Turned {
        Lanes h00, h10, h01, h11;
        Lanes x, y;
        Lanes bx0, bx1, by0, by1;  // steps from corner to corner, not relative to the texel: their signs are exact
    };
    static Turned turned(const Corners& c, const Seen& seen) {
        const LaneMask right = seen.dx >= 0.0f;
        const LaneMask up = seen.dy >= 0.0f;
        const Lanes low_near = right ? c.h00 : c.h10;
        const Lanes low_far = right ? c.h10 : c.h00;
        const Lanes high_near = right ? c.h01 : c.h11;
        const Lanes high_far = right ? c.h11 : c.h01;
        Turned t;
        t.h00 = up ? low_near : high_near;
        t.h10 = up ? low_far : high_far;
        t.h01 = up ? high_near : low_near;
        t.h11 = up ? high_far : low_far;
        t.x = most(seen.dx, -1.0f - seen.dx);
        t.y = most(seen.dy, -1.0f - seen.dy);
        t.bx0 = t.h10 - t.h00;
        t.bx1 = t.h11 - t.h01;
        t.by0 = t.h01 - t.h00;
        t.by1 = t.h11 - t.h10;
        return t;
    }

    // The two edges nearest to the texel, where the surface behind them falls.
    static void edges(const Corners& corners, const Seen& seen, const Metric& m, Lanes& k2) {
        const Turned c = turned(corners, seen);
        const Lanes corner = fall(c.x, c.bx0, c.y, c.by0);
        const Lanes x2 = c.x * c.x * m.u2;
        const Lanes y2 = c.y * c.y * m.v2;
        const Lanes rise = c.h00 - seen.apex;
        edge(corner, fall(c.x, c.bx1, c.y + 1.0f, c.by0), rise, c.h01 - seen.apex, c.by0, x2, c.y, m.v2, k2);
        edge(corner, fall(c.x + 1.0f, c.bx0, c.y, c.by1), rise, c.h10 - seen.apex, c.bx0, y2, c.x, m.u2, k2);
    }

    // The near edge from height h0 by b to h1, where the surface behind it falls by f0 to f1.
    static void edge(Lanes f0, Lanes f1, Lanes h0, Lanes h1, Lanes b, Lanes e2, Lanes along, float s2, Lanes& k2) {
        const Lanes highest = most(h0, h1);
        const LaneMask steeper =
            (least(f0, f1) < 0.0f) & (highest > 0.0f) & (k2 * slack * (e2 + along * along * s2) < highest * highest);
        if (!any(steeper)) return;
        const Part part = negative(f0, f1);
        const Lanes v = steepest(h0, b, e2, along, s2, part.low, part.high);
        // From the nearer end, so that little is lost to cancellation.
        const Lanes rise = v < 0.5f ? h0 + b * v : h1 - b * (1.0f - v);
        const Lanes far = along + v;
        k2 = steeper & (rise > 0.0f) ? most(k2, rise * rise / (e2 + far * far * s2)) : k2;
    }

    // Where the height a + b v over the squared distance e2 + (y + v)^2 s2 is steepest from the apex, v in [low, high]: the
    // quotient (a + b v) / distance rises, then falls, wherever it is positive; its derivative vanishes at  y + v = b e2 / (s2 (a -
    // b y)).
    static Lanes steepest(Lanes a, Lanes b, Lanes e2, Lanes y, float s2, Lanes low, Lanes high) {
        const Lanes at_foot = (a - b * y) * s2;
        const Lanes v = at_foot > 0.0f ? b * e2 / at_foot - y : high;
        return most(low, least(high, v));
    }

    template <int reach>
    struct Near {
        static constexpr int size = 2 * reach + 1;

        explicit Near(const Metric&) {}

        Lanes steepest(const Lanes (&height)[size][size], Lanes apex, const Metric& m) const {
            Lanes k2 = least_slope2 + Lanes{};
            for (int j = 0; j + 1 < size; ++j)
                for (int i = 0; i + 1 < size; ++i)
                    edges({height[j][i], height[j][i + 1], height[j + 1][i], height[j + 1][i + 1]},
                          {static_cast<float>(i - reach) + Lanes{}, static_cast<float>(j - reach) + Lanes{}, apex}, m, k2);
            return k2;
        }
    };

    // Somewhere it falls; d < 0, and the radial derivative, bilinear like H itself, has both signs. With a margin for rounding;
    // inside() decides.
    static LaneMask may_bind_inside(const Corners& corners, const Seen& seen, const Metric&, Lanes) {
        const Turned c = turned(corners, seen);
        const LaneMask twisted = (c.by1 - c.by0 <= 0x1p-20f * (magnitude(c.by0) + magnitude(c.by1))) &
                                 (least(least(c.bx0, c.bx1), least(c.by0, c.by1)) < 0.0f);
        if (!any(twisted)) return twisted;
        const Lanes far_x = c.x + 1.0f;
        const Lanes far_y = c.y + 1.0f;
        const Lanes g00 = c.x * c.bx0 + c.y * c.by0;
        const Lanes g10 = far_x * c.bx0 + c.y * c.by1;
        const Lanes g01 = c.x * c.bx1 + far_y * c.by0;
        const Lanes g11 = far_x * c.bx1 + far_y * c.by1;
        const Lanes margin =
            0x1p-20f * (far_x * (magnitude(c.bx0) + magnitude(c.bx1)) + far_y * (magnitude(c.by0) + magnitude(c.by1)));
        return twisted & (least(least(g00, g10), least(g01, g11)) < margin) & (most(most(g00, g10), most(g01, g11)) > -margin);
    }
};

inline void search_relaxed(const Rows& rows) { search_rows<RelaxedRule>(rows); }

}  // namespace relievo::cone_search::RELIEVO_MACHINE
