// The steepest slope from a texel to the declared surface, by brute force in double: what the exact cones are measured against.
#pragma once

#include "core/height_field.h"

#include <algorithm>
#include <cmath>

namespace relievo::test {

struct SlopeQuery {
    bool falling_only = false;  // only points where the surface falls outward, seen from the texel
    double level = 0;           // share of its terms by which a radial derivative may exceed 0 and still count as falling
    int lines = 32;             // a cell is searched along so many lines in each direction, and its sides
};

// 1 / max over points p above texel (x, y), at least 1, of (H(p) - h) / |p - x|: a ratio that is too wide by the distance between
// two lines at most, and in second order of it. Along a line of constant X or Y the surface is linear, so that the largest
// slope on it, or on its falling part, is known in closed form.
inline double surface_ratio(const HeightField& field, int x, int y, const SlopeQuery& query) {
    const int w = field.width();
    const int h = field.height();
    const double apex = field.texels(x, y);
    double best = 1;
    // The line from height n0 to n1 at distance `across` along [from, from + 1]; g0, g1: the radial derivative at its ends.
    const auto line = [&](double n0, double n1, double across, double across_size, double from, double size, double g0, double g1) {
        double low = 0;
        double high = 1;
        if (query.falling_only) {
            if (g0 >= 0 && g1 >= 0) return;
            if (g0 >= 0) low = g0 / (g0 - g1);
            if (g1 >= 0) high = g0 / (g0 - g1);
        }
        const double b = n1 - n0;
        const double e2 = across * across / (across_size * across_size);
        const auto slope = [&](double v) {
            const double rise = n0 + b * v;
            const double d2 = e2 + (from + v) * (from + v) / (size * size);
            return rise > 0 && d2 > 0 ? rise / std::sqrt(d2) : 0.0;
        };
        best = std::max({best, slope(low), slope(high)});
        const double foot = (n0 - b * from) / (size * size);
        if (foot > 0) best = std::max(best, slope(std::clamp(b * e2 / foot - from, low, high)));
    };
    for (int j = y - h - 1; j <= y + h; ++j)
        for (int i = x - w - 1; i <= x + w; ++i) {
            const auto c = field.cell(i, j);
            const double h00 = c[0] - apex, h10 = c[1] - apex, h01 = c[2] - apex, h11 = c[3] - apex;
            if (std::max({h00, h10, h01, h11}) <= 0) continue;
            const double x0 = i - x;
            const double y0 = j - y;
            if (!query.falling_only && x0 * (x0 + 1) == 0 && y0 * (y0 + 1) == 0) {
                // Beside the texel: the gradient at the texel itself, in the cell's own quadrant.
                const double right = y0 == 0 ? h10 - h00 : h11 - h01;
                const double up = x0 == 0 ? h01 - h00 : h11 - h10;
                const double gx = x0 == 0 ? right : -right;
                const double gy = y0 == 0 ? up : -up;
                if (gx > 0 && gy > 0) best = std::max(best, std::hypot(gx * w, gy * h));
            }
            const auto radial = [&](double px, double hx, double py, double hy) {
                return px * hx + py * hy - query.level * (std::abs(px * hx) + std::abs(py * hy));
            };
            for (int k = 0; k <= query.lines; ++k) {
                const double s = static_cast<double>(k) / query.lines;
                const double a0 = h00 + (h10 - h00) * s;
                const double a1 = h01 + (h11 - h01) * s;
                line(a0, a1, x0 + s, w, y0, h, radial(x0 + s, h10 - h00, y0, a1 - a0), radial(x0 + s, h11 - h01, y0 + 1, a1 - a0));
                const double b0 = h00 + (h01 - h00) * s;
                const double b1 = h10 + (h11 - h10) * s;
                line(b0, b1, y0 + s, h, x0, w, radial(x0, b1 - b0, y0 + s, h01 - h00), radial(x0 + 1, b1 - b0, y0 + s, h11 - h10));
            }
        }
    return 1 / best;
}

}  // namespace relievo::test
