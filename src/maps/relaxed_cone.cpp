#include "maps/relaxed_cone.h"

#include "maps/cone_search.h"

namespace relievo {

namespace {

using namespace cone_search;

struct RelaxedRule {
    static constexpr int channels = 4;

    // Somewhere in the cell H falls along some direction of the quadrant, if it falls along either of its axes on some edge.
    static float reach(const float* h, int quadrant) {
        const float sx = (quadrant & 1) != 0 ? -1.0f : 1.0f;
        const float sy = (quadrant & 2) != 0 ? -1.0f : 1.0f;
        const bool falls = sx * (h[1] - h[0]) < 0 || sx * (h[3] - h[2]) < 0 || sy * (h[2] - h[0]) < 0 || sy * (h[3] - h[1]) < 0;
        return falls ? std::max(std::max(h[0], h[1]), std::max(h[2], h[3])) : -1.0f;
    }

    // The part of an edge, [low, high] of [0,1], where a function that is linear from f0 to f1 is negative.
    template <class Lanes>
    struct Part {
        Lanes low, high;
        MaskOf<Lanes> some;
    };
    template <class Lanes>
    static Part<Lanes> negative(Lanes f0, Lanes f1) {
        const MaskOf<Lanes> first = f0 < 0.0f;
        const MaskOf<Lanes> last = f1 < 0.0f;
        const Lanes root = f0 / (f0 - f1);  // used only where the signs differ
        Part<Lanes> part;
        part.low = first ? Lanes{} : root;
        part.high = last ? 1.0f + Lanes{} : root;
        part.some = first | last;
        return part;
    }

    // X Hx + Y Hy, the radial derivative times the distance, less a margin for rounding.
    template <class Lanes>
    static Lanes fall(Lanes x, Lanes hx, Lanes y, Lanes hy) {
        return x * hx + y * hy - 0x1p-20f * (x * magnitude(hx) + y * magnitude(hy));
    }

    template <class Lanes>
    static Lanes edges(const CellLanes<Lanes>& c, const Metric& m) {
        const Lanes bx0 = c.h10 - c.h00;
        const Lanes bx1 = c.h11 - c.h01;
        const Lanes by0 = c.h01 - c.h00;
        const Lanes by1 = c.h11 - c.h10;
        const Lanes corner = fall(c.x, bx0, c.y, by0);
        const Part<Lanes> left = negative(corner, fall(c.x, bx1, c.y + 1.0f, by0));
        const Part<Lanes> below = negative(corner, fall(c.x + 1.0f, bx0, c.y, by1));
        const Lanes x2 = c.x * c.x * m.u2;
        const Lanes y2 = c.y * c.y * m.v2;
        const Lanes v = steepest(c.h00, by0, x2, c.y, m.v2, left.low, left.high);
        const Lanes u = steepest(c.h00, bx0, y2, c.x, m.u2, below.low, below.high);
        const Lanes none = no_limit + Lanes{};
        return least(left.some ? squared_ratio(c.h00, c.h01, x2, c.y, m.v2, v) : none,
                     below.some ? squared_ratio(c.h00, c.h10, y2, c.x, m.u2, u) : none);
    }

    // d < 0, and the radial derivative, bilinear like H itself, has both signs. With a margin for rounding; inside() decides.
    template <class Lanes>
    static MaskOf<Lanes> may_bind_inside(const CellLanes<Lanes>& c) {
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

    static double inside(const CellScalar& s, const Metric& m) {
        const double d = s.h11 - s.h10 - s.h01 + s.h00;
        if (!(d < 0)) return no_limit;
        const double bx = s.h10 - s.h00;
        const double by = s.h01 - s.h00;
        const double at_apex = s.h00 - s.x * bx - s.y * by + d * s.x * s.y;
        const double gx = (bx - d * s.y) * m.width;
        const double gy = (by - d * s.x) * m.height;
        const double twist2 = -2 * d * m.width * m.height;  // 2 D
        // The arc's part in this cell: Y = m / 2D and X = m / (2D t) between its sides, each side a linear condition on t.
        double first = 0;
        double last = 1e12;
        const auto at_least = [&](double slope, double value) {  // slope t >= value
            if (slope > 0) first = std::max(first, value / slope);
            else if (slope < 0) last = std::min(last, value / slope);
            else if (value > 0) last = -1;
        };
        at_least(gy, twist2 * s.y / m.height - gx);
        at_least(-gy, gx - twist2 * (s.y + 1) / m.height);
        at_least(gy - twist2 * s.x / m.width, -gx);
        at_least(twist2 * (s.x + 1) / m.width - gy, gx);
        if (!(first <= last)) return no_limit;

        const double cd4 = 2 * at_apex * twist2;
        double steepest_slope = 0;
        const auto meet = [&](double t) {
            const double along = gx + gy * t;
            if (along > 0) steepest_slope = std::max(steepest_slope, (along * along + cd4 * t) / (2 * along * std::sqrt(1 + t * t)));
        };
        meet(first);
        meet(last);
        const double k0 = gx * (gx * gy + cd4);
        const double k1 = gx * (2 * gy * gy - gx * gx);
        const double k2 = gy * (gy * gy - 2 * gx * gx);
        const double k3 = -gy * (gx * gy + cd4);
        const auto cubic = [&](double t) { return ((k3 * t + k2) * t + k1) * t + k0; };
        // Between the places where the cubic itself turns it has one root at most.
        double turns[4] = {first, last, last, last};
        int pieces = 1;
        const double under_root = k2 * k2 - 3 * k3 * k1;
        if (under_root > 0) {
            const double half = -(k2 + std::copysign(std::sqrt(under_root), k2));
            double t0 = half / (3 * k3);
            double t1 = k1 / half;
            if (t1 < t0) std::swap(t0, t1);
            if (t0 > first && t0 < last) turns[pieces++] = t0;
            if (t1 > first && t1 < last) turns[pieces++] = t1;
            turns[pieces] = last;
        }
        for (int piece = 0; piece < pieces; ++piece) {
            meet(falling_root(cubic, turns[piece], turns[piece + 1]));  // a largest slope lies only where its derivative falls
        }
        return steepest_slope > 0 ? 1 / (steepest_slope * steepest_slope) : no_limit;
    }
};

}  // namespace

ImageF relaxed_cone(const HeightField& field, int threads, const Progress& progress) {
    return cone_search::cones<RelaxedRule>(field, threads, progress, "relaxed cone");
}

}  // namespace relievo
