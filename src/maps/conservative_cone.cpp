#include "maps/conservative_cone.h"

#include "maps/cone_search.h"

namespace relievo::cone_search {

struct ConservativeCells {
    static constexpr bool directional = false;

    static double inside(const Cell& s, const Metric& m, double steeper_than) {
        const double d = s.h11 - s.h10 - s.h01 + s.h00;
        if (!(d < 0)) return 0;
        const double bx = s.h10 - s.h00;
        const double by = s.h01 - s.h00;
        if (s.x == 0 && s.y == 0) {
            if (bx <= 0 || by <= 0) return 0;
            const double gx = bx * m.width;
            const double gy = by * m.height;
            return gx * gx + gy * gy;
        }
        const double at_apex = s.h00 - s.x * bx - s.y * by + d * s.x * s.y;
        if (!(at_apex < 0)) return 0;
        const double gx = (bx - d * s.y) * m.width;
        const double gy = (by - d * s.x) * m.height;
        const double twist = d * m.width * m.height;
        const double product = at_apex / twist;  // X Y on the hyperbola, in UV
        const double k = 2 * std::sqrt(at_apex * twist);
        const double first_x = std::max(s.x / m.width, product * m.height / (s.y + 1));
        const double last_x = std::min((s.x + 1) / m.width, s.y > 0 ? product * m.height / s.y : 2.0);
        if (!(first_x < last_x)) return 0;
        // On the arc the height is 2 C + gx X + gy Y, which is largest at one of its ends.
        const auto height = [&](double x) { return 2 * at_apex + gx * x + gy * product / x; };
        const double highest = std::max(height(first_x), height(last_x));
        const double nearest2 = first_x * first_x + (product / last_x) * (product / last_x);
        if (!(highest > 0) || nearest2 * steeper_than * slack >= highest * highest) return 0;
        const double root = std::sqrt(product);
        const double first = root / last_x;
        const double last = root / first_x;
        // Concave up to gx / k and convex from there: the largest slope, if it lies between the arc's ends, lies between the top of
        // the one part and the bottom of the other.
        const auto rises = [&](double w) { return (k * w - 2 * gx) * w * w * w + 2 * gy * w - k; };
        const auto bends = [&](double w) { return (4 * k * w - 6 * gx) * w * w + 2 * gy; };
        const double turn = std::clamp(gx / k, first, last);
        const double low = falling_root(bends, first, turn);
        if (!(rises(low) > 0)) return 0;
        const double high = falling_root([&](double w) { return -bends(w); }, turn, last);
        if (!(rises(high) < 0)) return 0;
        const double w = falling_root(rises, low, high);
        const double slope = gx + gy * w * w - k * w;
        return slope > 0 ? slope * slope / (1 + w * w * w * w) : 0;
    }
};

}  // namespace relievo::cone_search

#define RELIEVO_LANES_CODE "maps/conservative_cone_lanes.h"
#include "core/each_machine.h"

namespace relievo {

ImageF conservative_cone(const HeightField& field, int threads, const Progress& progress) {
    return cone_search::cones<cone_search::ConservativeCells>(field, threads, progress, "conservative cone",
                                                              RELIEVO_BEST_MACHINE(cone_search, search_conservative));
}

}  // namespace relievo
