#include "maps/relaxed_cone.h"

#include "maps/cone_search.h"

namespace relievo::cone_search {

struct RelaxedCells {
    static constexpr int channels = 4;

    // Somewhere in the cell H falls along some direction of the quadrant, if it falls along either of its axes on some edge.
    static float reach(const float* h, int quadrant) {
        const float sx = (quadrant & 1) != 0 ? -1.0f : 1.0f;
        const float sy = (quadrant & 2) != 0 ? -1.0f : 1.0f;
        const bool falls = sx * (h[1] - h[0]) < 0 || sx * (h[3] - h[2]) < 0 || sy * (h[2] - h[0]) < 0 || sy * (h[3] - h[1]) < 0;
        return falls ? std::max(std::max(h[0], h[1]), std::max(h[2], h[3])) : -1.0f;
    }

    static double inside(const Cell& s, const Metric& m, double least) {
        const double d = s.h11 - s.h10 - s.h01 + s.h00;
        if (!(d < 0)) return no_limit;
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
            if (slope > 0) first = std::max(first, value / slope);
            else if (slope < 0) last = std::min(last, value / slope);
            else if (value > 0) last = -1;
        };
        at_least(gy, twist2 * s.y / m.height - gx);
        at_least(-gy, gx - twist2 * (s.y + 1) / m.height);
        at_least(gy - twist2 * s.x / m.width, -gx);
        at_least(twist2 * (s.x + 1) / m.width - gy, gx);
        if (!(first <= last)) return no_limit;

        // On the arc X and Y are monotone, and the height C + D X Y is largest at one of its ends.
        const double along0 = gx + gy * first;
        const double along1 = gx + gy * last;
        const double highest = at_apex + std::max(along0 * along0 / first, along1 * along1 / last) / (2 * twist2);
        const double near_x = std::max(s.x / m.width, std::min(along0 / first, along1 / last) / twist2);
        const double near_y = std::max(s.y / m.height, std::min(along0, along1) / twist2);
        if (!(highest > 0) || near_x * near_x + near_y * near_y >= least * highest * highest) return no_limit;

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

}  // namespace relievo::cone_search

#define RELIEVO_LANES_CODE "maps/relaxed_cone_lanes.h"
#include "core/each_machine.h"

namespace relievo {

ImageF relaxed_cone(const HeightField& field, int threads, const Progress& progress) {
    return cone_search::cones<cone_search::RelaxedCells>(field, threads, progress, "relaxed cone", RELIEVO_BEST_MACHINE(cone_search, search_relaxed));
}

}  // namespace relievo
