#include "maps/relaxed_cone.h"

#include "maps/cone_search.h"

namespace relievo::cone_search {

struct RelaxedCells {
    static constexpr bool directional = true;

    // The octants in which a cell falls, along some direction and somewhere: then it does so along one of the octant's two ends.
    // The steps along x and y vary each by itself, and linearly.
    static Octants octants(float h00, float h10, float h01, float h11) {
        const float x0 = std::min(h10 - h00, h11 - h01);
        const float x1 = std::max(h10 - h00, h11 - h01);
        const float y0 = std::min(h01 - h00, h11 - h10);
        const float y1 = std::max(h01 - h00, h11 - h10);
        // A sum within rounding of 0 counts as falling; steps of 0 alone are exact, and do not.
        const auto falls = [](float a, float b) { return a + b < 0x1p-22f * (std::abs(a) + std::abs(b)) ? 1u : 0u; };
        const unsigned ends = falls(x0, 0) | falls(x0, y0) << 1 | falls(0, y0) << 2 | falls(-x1, y0) << 3 | falls(-x1, 0) << 4 |
                              falls(-x1, -y1) << 5 | falls(0, -y1) << 6 | falls(x0, -y1) << 7;
        return static_cast<Octants>(ends | ends >> 1 | ends << 7);
    }

    static double inside(const Cell& s, const Metric& m, double steeper_than) {
        const double d = s.h11 - s.h10 - s.h01 + s.h00;
        if (!(d < 0)) return 0;
        const double bx = s.h10 - s.h00;
        const double by = s.h01 - s.h00;
        const double at_apex = s.h00 - s.x * bx - s.y * by + d * s.x * s.y;
        const double gx = (bx - d * s.y) * m.width;
        const double gy = (by - d * s.x) * m.height;
        const double twist2 = -2 * d * m.width * m.height;  // 2 D
        // The arc's part in this cell: Y = m / 2D and X = m / (2D t) between its sides, each side a linear condition on t.
        double first = 1e-12;
        double last = 1e12;
        const auto at_least = [&](double slope, double value) {  // slope t >= value
            if (slope > 0)
                first = std::max(first, value / slope);
            else if (slope < 0)
                last = std::min(last, value / slope);
            else if (value > 0)
                last = -1;
        };
        at_least(gy, twist2 * s.y / m.height - gx);
        at_least(-gy, gx - twist2 * (s.y + 1) / m.height);
        at_least(gy - twist2 * s.x / m.width, -gx);
        at_least(twist2 * (s.x + 1) / m.width - gy, gx);
        if (!(first <= last)) return 0;

        // On the arc X and Y are monotone, and the height C + D X Y is largest at one of its ends.
        const double along0 = gx + gy * first;
        const double along1 = gx + gy * last;
        const double highest = at_apex + std::max(along0 * along0 / first, along1 * along1 / last) / (2 * twist2);
        const double near_x = std::max(s.x / m.width, std::min(along0 / first, along1 / last) / twist2);
        const double near_y = std::max(s.y / m.height, std::min(along0, along1) / twist2);
        if (!(highest > 0) || (near_x * near_x + near_y * near_y) * steeper_than * slack >= highest * highest) return 0;

        const double cd4 = 2 * at_apex * twist2;
        double steepest2 = 0;
        const auto meet = [&](double t) {
            const double along = gx + gy * t;
            const double rise = along * along + cd4 * t;
            if (along > 0 && rise > 0) steepest2 = std::max(steepest2, rise * rise / (4 * along * along * (1 + t * t)));
        };
        meet(first);
        meet(last);
        const double k0 = gx * (gx * gy + cd4);
        const double k1 = gx * (2 * gy * gy - gx * gx);
        const double k2 = gy * (gy * gy - 2 * gx * gx);
        const double k3 = -gy * (gx * gy + cd4);
        const auto cubic = [&](double t) { return ((k3 * t + k2) * t + k1) * t + k0; };
        // In Bernstein form between the ends: with no change of sign there, the steepest place is an end. Short arcs mostly have
        // none.
        const auto derivative = [&](double t) { return (3 * k3 * t + 2 * k2) * t + k1; };
        const double third = (last - first) / 3;
        const double b0 = cubic(first);
        const double b3 = cubic(last);
        const double b1 = b0 + third * derivative(first);
        const double b2 = b3 - third * derivative(last);
        const double rounding = 0x1p-44 * (((std::abs(k3) * last + std::abs(k2)) * last + std::abs(k1)) * last + std::abs(k0));
        if (std::max(std::max(b0, b1), std::max(b2, b3)) <= -rounding || std::min(std::min(b0, b1), std::min(b2, b3)) >= rounding)
            return steepest2;
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
        for (int piece = 0; piece < pieces; ++piece)  // a largest slope lies only where its derivative falls
            if (cubic(turns[piece]) > 0 && cubic(turns[piece + 1]) < 0) meet(falling_root(cubic, turns[piece], turns[piece + 1]));
        return steepest2;
    }
};

}  // namespace relievo::cone_search

#define RELIEVO_LANES_CODE "maps/relaxed_cone_lanes.h"
#include "core/each_machine.h"

namespace relievo {

ImageF relaxed_cone(const HeightField& field, int threads, const Progress& progress) {
    return cone_search::cones<cone_search::RelaxedCells>(field, threads, progress, "relaxed cone",
                                                         RELIEVO_BEST_MACHINE(cone_search, search_relaxed));
}

}  // namespace relievo
