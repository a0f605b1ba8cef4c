#include "maps/conservative_cone.h"

#include "maps/cone_search.h"

namespace relievo {

namespace {

using namespace cone_search;

struct ConservativeRule {
    static constexpr int channels = 1;

    static float reach(const float* h, int) { return std::max(std::max(h[0], h[1]), std::max(h[2], h[3])); }

    template <class Lanes>
    static Lanes edges(const CellLanes<Lanes>& c, const Metric& m) {
        const Lanes x2 = c.x * c.x * m.u2;
        const Lanes y2 = c.y * c.y * m.v2;
        const Lanes v = steepest(c.h00, c.h01 - c.h00, x2, c.y, m.v2, Lanes{}, 1.0f + Lanes{});
        const Lanes u = steepest(c.h00, c.h10 - c.h00, y2, c.x, m.u2, Lanes{}, 1.0f + Lanes{});
        return least(squared_ratio(c.h00, c.h01, x2, c.y, m.v2, v), squared_ratio(c.h00, c.h10, y2, c.x, m.u2, u));
    }

    // d < 0, and the slope along the ray grows at the near corner and shrinks at the far one: X Hx + Y Hy - (H - h_x) = d X Y - C
    // changes its sign between them. With a margin for rounding; inside() decides.
    template <class Lanes>
    static MaskOf<Lanes> may_bind_inside(const CellLanes<Lanes>& c) {
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

    static double inside(const CellScalar& s, const Metric& m) {
        const double d = s.h11 - s.h10 - s.h01 + s.h00;
        if (!(d < 0)) return no_limit;
        const double bx = s.h10 - s.h00;
        const double by = s.h01 - s.h00;
        if (s.x == 0 && s.y == 0) {
            if (bx <= 0 || by <= 0) return no_limit;
            const double gx = bx * m.width;
            const double gy = by * m.height;
            return 1 / (gx * gx + gy * gy);
        }
        const double at_apex = s.h00 - s.x * bx - s.y * by + d * s.x * s.y;
        if (!(at_apex < 0)) return no_limit;
        const double gx = (bx - d * s.y) * m.width;
        const double gy = (by - d * s.x) * m.height;
        const double twist = d * m.width * m.height;
        const double product = at_apex / twist;  // X Y on the hyperbola, in UV
        const double k = 2 * std::sqrt(at_apex * twist);
        const double first_x = std::max(s.x / m.width, product * m.height / (s.y + 1));
        const double last_x = std::min((s.x + 1) / m.width, s.y > 0 ? product * m.height / s.y : 2.0);
        if (!(first_x < last_x)) return no_limit;
        const double root = std::sqrt(product);
        const double first = root / last_x;
        const double last = root / first_x;
        // Concave up to gx / k and convex from there: the largest slope, if it lies between the arc's ends, lies between the top of
        // the one part and the bottom of the other.
        const auto rises = [&](double w) { return (k * w - 2 * gx) * w * w * w + 2 * gy * w - k; };
        const auto bends = [&](double w) { return (4 * k * w - 6 * gx) * w * w + 2 * gy; };
        const double turn = std::clamp(gx / k, first, last);
        const double low = falling_root(bends, first, turn);
        const double high = falling_root([&](double w) { return -bends(w); }, turn, last);
        if (!(rises(low) > 0 && rises(high) < 0)) return no_limit;
        const double w = falling_root(rises, low, high);
        const double slope = gx + gy * w * w - k * w;
        return slope > 0 ? (1 + w * w * w * w) / (slope * slope) : no_limit;
    }
};

}  // namespace

ImageF conservative_cone(const HeightField& field, int threads, const Progress& progress) {
    return cone_search::cones<ConservativeRule>(field, threads, progress, "conservative cone");
}

}  // namespace relievo
