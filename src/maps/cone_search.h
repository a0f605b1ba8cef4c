// What the searches for cones share and what does not depend on the machine's lanes (cone_search_lanes.h).
#pragma once

#include "core/height_field.h"
#include "core/parallel_for.h"
#include "core/progress.h"
#include "maps/planes_above.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <string_view>
#include <vector>

namespace relievo::cone_search {

constexpr int tile = 8;        // texels a side that search together
constexpr int leaf_level = 2;  // blocks of 4x4 texels are taken texel by texel

// Tests compare products with squares instead of dividing; this much less never closes a node that the division would have opened.
constexpr float slack = 1.0f - 0x1p-20f;
// A found ratio is lowered by this share. Every quantity below carries at most some ten roundings of 2^-24.
constexpr float rounding_down = 1.0f - 0x1p-20f;
// No slope below this is looked for: ratios are at most 1. Slopes of 1 are, so that a cone of ratio 1 that the surface touches all
// along a line is lowered like any other.
constexpr float least_slope2 = 1.0f - 0x1p-20f;

// A cell as one texel sees it, turned so that it lies in the quadrant of positive x and y: every cell lies wholly in one closed
// quadrant of every texel centre. Heights are relative to the texel's, places in texels from it.
struct Cell {
    double h00, h10, h01, h11;  // h00 is the corner nearest to the texel
    double x, y;                // of that corner, whole and >= 0
};

// UV units per texel, and how texels stand for what is between them.
struct Metric {
    int width, height;
    float du, dv;
    float u2, v2;  // (UV per texel)^2
    // For a point p of a cell let r(p) be its distance from the apex and r_i those of the corners. The blend of the r_i^2 exceeds
    // r(p)^2 by a (1-a) du^2 + b (1-b) dv^2, at most k = (du^2 + dv^2) / 4; and since the square root is concave, the blend of the
    // sqrt(r_i^2 - k) is at most r(p). So if every corner obeys  h_i - h <= K sqrt(r_i^2 - k),  every point obeys  h(p) - h <= K
    // r(p): it is enough to look at texels, each a little nearer than it is. k has to stay below the squared distances it is taken
    // from; where texels are so much longer than wide that it does not, a texel counts as near as its cells instead, and k is 0.
    float nearer;
    float step;  // texels taken off each gap: 0, or 1 in the second case

    Metric(int w, int h)
        : width(w),
          height(h),
          du(1.0f / static_cast<float>(w)),
          dv(1.0f / static_cast<float>(h)),
          u2(1.0f / (static_cast<float>(w) * static_cast<float>(w))),
          v2(1.0f / (static_cast<float>(h) * static_cast<float>(h))) {
        const float k = 0.25f * (u2 + v2);
        const bool near_square = k < 0.9f * std::min(u2, v2);
        nearer = near_square ? k : 0.0f;
        step = near_square ? 0.0f : 1.0f;
    }
};

// The octants from +x on, towards +y, in texels: the directions of one lie between 45 degrees times its number and its number + 1.
using Octants = std::uint8_t;

// What may limit a cone: the height of texels, largest of blocks of 2^k x 2^k of them, up to a single node; sizes rounded up. Where
// Cells::directional, a cell counts only as seen in the octants Cells::octants(corners), and there is a channel for each quadrant
// (x negative + 2 y negative): of the texels that are corners of such cells, and -1 where there are none. Planes lie above the
// texels of the blocks from leaf_level on (planes_above.h).
struct Reach {
    std::vector<ImageF> levels, planes;
};

template <class Cells>
Reach reach_of(const HeightField& field, int threads) {
    const int w = field.width();
    const int h = field.height();
    Reach reach;
    if constexpr (Cells::directional) {
        std::vector<Octants> cells(static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
        const auto row = [&](int j) { return cells.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(w); };
        parallel_for(h, 64, threads, [&](int begin, int end) {
            for (int j = begin; j < end; ++j) {
                const float* low = field.texels.at(0, j);
                const float* high = field.texels.at(0, j + 1 == h ? 0 : j + 1);
                for (int i = 0; i < w; ++i) {
                    const int i1 = i + 1 == w ? 0 : i + 1;
                    row(j)[i] = Cells::octants(low[i], low[i1], high[i], high[i1]);
                }
            }
        });
        reach.levels.emplace_back(w, h, 4);
        parallel_for(h, 64, threads, [&](int begin, int end) {
            for (int j = begin; j < end; ++j) {
                const Octants* below = row(j == 0 ? h - 1 : j - 1);
                const Octants* above = row(j);
                for (int i = 0; i < w; ++i) {
                    const int i0 = i == 0 ? w - 1 : i - 1;
                    const unsigned o = below[i0] | below[i] | above[i0] | above[i];
                    const float height = field.texels(i, j);
                    float* to = reach.levels[0].at(i, j);
                    to[0] = (o & 0x03) != 0 ? height : -1.0f;
                    to[1] = (o & 0x0c) != 0 ? height : -1.0f;
                    to[2] = (o & 0xc0) != 0 ? height : -1.0f;
                    to[3] = (o & 0x30) != 0 ? height : -1.0f;
                }
            }
        });
    } else {
        reach.levels.push_back(field.texels);
    }
    while (reach.levels.back().width > 1 || reach.levels.back().height > 1 || static_cast<int>(reach.levels.size()) <= leaf_level) {
        const ImageF& from = reach.levels.back();
        ImageF to((from.width + 1) / 2, (from.height + 1) / 2, from.channels);
        parallel_for(to.height, 64, threads, [&](int begin, int end) {
            for (int j = begin; j < end; ++j)
                for (int i = 0; i < to.width; ++i) {
                    const int i1 = std::min(2 * i + 1, from.width - 1);
                    const int j1 = std::min(2 * j + 1, from.height - 1);
                    for (int c = 0; c < from.channels; ++c)
                        to(i, j, c) = std::max(std::max(from(2 * i, 2 * j, c), from(i1, 2 * j, c)),
                                               std::max(from(2 * i, j1, c), from(i1, j1, c)));
                }
        });
        reach.levels.push_back(std::move(to));
    }
    reach.planes = planes_above(field.texels, leaf_level, static_cast<int>(reach.levels.size()) - 1, threads);
    return reach;
}

// Rows of tiles to search.
struct Rows {
    const HeightField& field;
    const Reach& reach;
    int begin, end;
    ImageF& cones;
};

template <class Cells>
ImageF cones(const HeightField& field, int threads, const Progress& progress, std::string_view stage, void (*search)(const Rows&)) {
    ImageF result(field.width(), field.height(), 2);
    const std::vector<float>& heights = field.texels.texels;
    if (std::adjacent_find(heights.begin(), heights.end(), std::not_equal_to<>()) == heights.end()) {
        // A level field: nothing to search, and nothing to prepare for it.
        for (std::size_t k = 0; k < heights.size(); ++k) {
            result.texels[2 * k] = heights[k];
            result.texels[2 * k + 1] = 1.0f;
        }
        return result;
    }
    const Reach reach = reach_of<Cells>(field, threads);
    parallel_for((field.height() + tile - 1) / tile, 1, threads,
                 [&](int begin, int end) {
                     search({field, reach, begin, end, result});
                 },
                 progress, stage);
    return result;
}

// Where f, positive before and negative after it, changes its sign in [low, high], both above 0; the nearer end if it does not.
// First by the exponent, for an end may be as far as 10^12, then to 2^-30 of what is left: the slopes looked for are level there,
// so that this is more than enough. Most f are nearly straight there, and a secant finds the place in a third of the steps that
// halving takes; no f takes more than one step more: Oliveira & Takahashi (2020), "An Enhancement of the Bisection Method Average
// Performance Preserving Minmax Optimality", with kappa_1 0.2, kappa_2 2 and n_0 1.
template <class Function>
double falling_root(const Function& f, double low, double high) {
    double at_low = f(low);
    if (!(at_low > 0)) return low;
    double at_high = f(high);
    if (!(at_high < 0)) return high;
    while (high > 4 * low) {
        const double mid = std::sqrt(low * high);
        const double at_mid = f(mid);
        (at_mid > 0 ? low : high) = mid;
        (at_mid > 0 ? at_low : at_high) = at_mid;
    }
    const double whole = high - low;
    const double enough = 0x1p-30 * whole;
    double halved = whole;  // what one step more of halving would have left by now
    for (int step = 0; step <= 30 && high - low > enough; ++step) {
        const double width = high - low;
        const double mid = 0.5 * (low + high);
        const double secant = low + width * (at_low / (at_low - at_high));
        const double inward = 0.2 * width * width / whole;
        const double to_mid = mid - secant;
        double at = std::abs(to_mid) > inward ? secant + std::copysign(inward, to_mid) : mid;
        const double reach = halved - 0.5 * width;
        if (std::abs(at - mid) > reach) at = mid - std::copysign(reach, to_mid);
        const double there = f(at);
        if (there > 0) {
            low = at;
            at_low = there;
        } else if (there < 0) {
            high = at;
            at_high = there;
        } else {
            return at;
        }
        halved *= 0.5;
    }
    return 0.5 * (low + high);
}

}  // namespace relievo::cone_search
