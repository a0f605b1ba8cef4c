// What the searches for cones of the declared surface share and what does not depend on the machine's lanes (cone_search_lanes.h).
#pragma once

#include "core/height_field.h"
#include "core/parallel_for.h"
#include "core/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

namespace relievo::cone_search {

constexpr int tile_w = 8;
constexpr int tile_h = 8;
constexpr int leaf_level = 2;  // blocks of 4x4 cells are taken cell by cell

// Tests compare d2 with q rise^2 instead of dividing; rounding never closes a node that a division would have let through.
constexpr float slack = 1.0f + 0x1p-20f;
// A found ratio is lowered by this share. Every quantity below carries at most some ten roundings of 2^-24.
constexpr float rounding_down = 1.0f - 0x1p-20f;
constexpr float no_limit = 4.0f;  // a squared ratio above every bound

struct Corners {
    float h00, h10, h01, h11;
};

// A cell as one texel sees it, turned so that it lies in the quadrant of positive x and y: every cell lies wholly in one closed quadrant
// of every texel centre. Heights are relative to the texel's, places in texels from it.
struct Cell {
    double h00, h10, h01, h11;  // h00 is the corner nearest to the texel
    double x, y;                // of that corner, whole and >= 0
};

struct Metric {
    int width, height;
    float u2, v2;  // (UV per texel)^2
};

// Highest reach of groups of 2^k x 2^k cells, up to a single node; sizes rounded up.
// Rule::reach(corners h00, h10, h01, h11, channel) is the highest point of a cell that may limit a cone, below 0 if none may; there is
// one channel, or one for each quadrant a cell is seen in (x negative + 2 y negative).
template <class Rule>
std::vector<ImageF> reaches(const HeightField& field, int threads) {
    const int w = field.width();
    const int h = field.height();
    std::vector<ImageF> levels{ImageF(w, h, Rule::channels)};
    parallel_for(h, 64, threads, [&](int begin, int end) {
        for (int j = begin; j < end; ++j)
            for (int i = 0; i < w; ++i) {
                const int i1 = i + 1 == w ? 0 : i + 1;
                const int j1 = j + 1 == h ? 0 : j + 1;
                const float corners[4] = {field.texels(i, j), field.texels(i1, j), field.texels(i, j1), field.texels(i1, j1)};
                for (int c = 0; c < Rule::channels; ++c) levels[0](i, j, c) = Rule::reach(corners, c);
            }
    });
    while (levels.back().width > 1 || levels.back().height > 1 || static_cast<int>(levels.size()) <= leaf_level) {
        const ImageF& from = levels.back();
        ImageF to((from.width + 1) / 2, (from.height + 1) / 2, Rule::channels);
        parallel_for(to.height, 64, threads, [&](int begin, int end) {
            for (int j = begin; j < end; ++j)
                for (int i = 0; i < to.width; ++i) {
                    const int i1 = std::min(2 * i + 1, from.width - 1);
                    const int j1 = std::min(2 * j + 1, from.height - 1);
                    for (int c = 0; c < Rule::channels; ++c)
                        to(i, j, c) = std::max(std::max(from(2 * i, 2 * j, c), from(i1, 2 * j, c)), std::max(from(2 * i, j1, c), from(i1, j1, c)));
                }
        });
        levels.push_back(std::move(to));
    }
    return levels;
}

// Rows of tiles to search.
struct Rows {
    const HeightField& field;
    const std::vector<ImageF>& levels;
    int begin, end;
    ImageF& cones;
};

template <class Rule>
ImageF cones(const HeightField& field, int threads, const Progress& progress, std::string_view stage, void (*search)(const Rows&)) {
    const std::vector<ImageF> levels = reaches<Rule>(field, threads);
    ImageF result(field.width(), field.height(), 2);
    parallel_for((field.height() + tile_h - 1) / tile_h, 1, threads,
                 [&](int begin, int end) { search({field, levels, begin, end, result}); }, progress, stage);
    return result;
}

// Where f, positive before and negative after it, changes its sign in [low, high]; the nearer end if it does not. To 2^-30 of the
// interval: the slopes looked for are level there, so that this is more than enough.
template <class Function>
double falling_root(const Function& f, double low, double high) {
    if (!(f(low) > 0)) return low;
    if (!(f(high) < 0)) return high;
    for (int i = 0; i < 30; ++i) {
        const double mid = 0.5 * (low + high);
        (f(mid) > 0 ? low : high) = mid;
    }
    return 0.5 * (low + high);
}

}  // namespace relievo::cone_search
