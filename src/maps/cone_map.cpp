#include "maps/cone_map.h"

#include "core/four_lanes.h"
#include "core/parallel_for.h"
#include "maps/texel_maxima.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstddef>
#include <cstdint>
#include <vector>

// Branch and bound over a pyramid of texel maxima. All texels of a small tile search together: a node is opened if any of them
// may find its limit there, so that the walk is paid once a tile and the tests run in SIMD lanes. A node is closed for a texel of
// height h once   d2(texel, node) >= q (max(node) - h)^2,   nearest nodes first, so that q is small when far ones are met.

namespace relievo {

namespace {

// 8x8 and 8x4 texels were fastest; 8x2 and 4x4 took twice as long, for they share less.
constexpr int tile_w = 8;
constexpr int tile_h = 8;
constexpr int leaf_level = 2;  // blocks of 4x4 texels are compared texel by texel

constexpr int lanes = 4;
constexpr int tile_columns = tile_w / lanes;

// The tests compare d2 with q rise^2 instead of dividing. Three roundings of 2^-24 separate the two forms; a q widened by
// this much never closes a node that the division would have let through.
constexpr float slack = 1.0f + 0x1p-20f;

// (d/size)^2 for whole texel distances d along one axis, unwrapped; at(d) takes either sign.
class SquaredDistances {
public:
    explicit SquaredDistances(int size) : zero_(2 * size + tile_w), table_(static_cast<std::size_t>(2 * zero_ + 1)) {
        for (int d = -zero_; d <= zero_; ++d) table_[static_cast<std::size_t>(d + zero_)] = squared_distance(std::abs(d), size);
    }
    // Distances of `d`, d + 1, d + 2 ...
    const float* at(int d) const { return table_.data() + (d + zero_); }

private:
    int zero_;
    std::vector<float> table_;
};

struct Node {
    int level, i, j;         // in the pyramid
    int origin_x, origin_y;  // of the repeat it is taken from, texels
};

class TileSearch {
public:
    TileSearch(const std::vector<ImageF>& maxima, const SquaredDistances& u2, const SquaredDistances& v2)
        : maxima_(maxima), u2_(u2), v2_(v2), width_(maxima[0].width), height_(maxima[0].height) {}

    // Finds the cones of the texels of the tile whose first texel is (x0, y0), and writes them.
    void run(int x0, int y0, ImageF& cones) {
        x0_ = x0;
        y0_ = y0;
        lowest_ = 2;
        for (int r = 0; r < tile_h; ++r)
            for (int c = 0; c < tile_w; ++c) {
                const bool exists = x0 + c < width_ && y0 + r < height_;
                // Lanes beyond the map stand above everything, so nothing ever limits them.
                const float apex = exists ? maxima_[0](x0 + c, y0 + r) : 2.0f;
                apex_[r][c / lanes][c % lanes] = apex;
                q_[r][c / lanes][c % lanes] = 1.0f;
                bound_[r][c / lanes][c % lanes] = exists ? slack : 0.0f;
                lowest_ = std::min(lowest_, apex);
            }
        widest_ = slack;

        // What limits a texel of a rough field is mostly beside it; having that first closes most nodes.
        for (int j = y0 - 2; j < y0 + tile_h + 2; ++j)
            for (int i = x0 - 2; i < x0 + tile_w + 2; ++i) compare(i, j, maxima_[0](wrap_index(i, width_), wrap_index(j, height_)));
        tighten();
        search();

        for (int r = 0; r < tile_h && y0 + r < height_; ++r)
            for (int c = 0; c < tile_w && x0 + c < width_; ++c) {
                cones(x0 + c, y0 + r, 0) = apex_[r][c / lanes][c % lanes];
                cones(x0 + c, y0 + r, 1) = std::sqrt(q_[r][c / lanes][c % lanes]);
            }
    }

private:
    void search() {
        const int top = static_cast<int>(maxima_.size()) - 1;
        open_.clear();
        for (int b = -1; b <= 1; ++b)
            for (int a = -1; a <= 1; ++a)
                if (a != 0 || b != 0) open_.push_back({top, 0, 0, a * width_, b * height_});
        open_.push_back({top, 0, 0, 0, 0});
        while (!open_.empty()) {
            const Node n = open_.back();
            open_.pop_back();
            if (!may_limit(n)) continue;
            if (n.level == leaf_level) {
                compare_block(n);
                continue;
            }
            // Nearest child last, so that it is taken first.
            const ImageF& below = maxima_[static_cast<std::size_t>(n.level - 1)];
            const int near_i = x0_ >= n.origin_x + ((2 * n.i + 1) << (n.level - 1)) ? 1 : 0;
            const int near_j = y0_ >= n.origin_y + ((2 * n.j + 1) << (n.level - 1)) ? 1 : 0;
            for (int k = 3; k >= 0; --k) {
                const int i = 2 * n.i + (near_i ^ (k & 1));
                const int j = 2 * n.j + (near_j ^ (k >> 1));
                if (i < below.width && j < below.height) open_.push_back({n.level - 1, i, j, n.origin_x, n.origin_y});
            }
        }
    }

    // Nodes at least as wide as the tile either hold its columns (or rows) or lie beside them; smaller ones may lie inside.
    const float* gap2(const SquaredDistances& squared, int first, int count, int low, int high) const {
        static constexpr float none[tile_w] = {};
        if (first + count <= low) return squared.at(first - low);
        if (first > high) return squared.at(first - high);
        return none;
    }

    bool may_limit(const Node& n) const {
        const float most = maxima_[static_cast<std::size_t>(n.level)](n.i, n.j);
        if (most <= lowest_) return false;
        const int low_x = n.origin_x + (n.i << n.level);
        const int low_y = n.origin_y + (n.j << n.level);
        const int high_x = n.origin_x + std::min(width_, (n.i + 1) << n.level) - 1;
        const int high_y = n.origin_y + std::min(height_, (n.j + 1) << n.level) - 1;
        const float* du2 = gap2(u2_, x0_, tile_w, low_x, high_x);
        const float* dv2 = gap2(v2_, y0_, tile_h, low_y, high_y);
        const float least = std::min(du2[0], du2[tile_w - 1]) + std::min(dv2[0], dv2[tile_h - 1]);
        const float highest_rise = most - lowest_;
        if (least >= widest_ * highest_rise * highest_rise) return false;
        return any_within(most, du2, dv2);
    }

    bool any_within(float most, const float* du2, const float* dv2) const {
        FourMask within{};
        for (int c = 0; c < tile_columns; ++c) {
            const FourLanes u = four_from(du2 + c * lanes);
            for (int r = 0; r < tile_h; ++r) {
                const FourLanes rise = most - apex_[r][c];
                within |= (u + dv2[r] < bound_[r][c] * rise * rise) & (rise > 0.0f);
            }
        }
        return any(within);
    }

    void compare_block(const Node& n) {
        const int end_x = std::min(width_, (n.i + 1) << n.level);
        const int end_y = std::min(height_, (n.j + 1) << n.level);
        bool changed = false;
        for (int j = n.j << n.level; j < end_y; ++j)
            for (int i = n.i << n.level; i < end_x; ++i) changed |= compare(n.origin_x + i, n.origin_y + j, maxima_[0](i, j));
        if (changed) tighten();
    }

    // The tile's texels against the texel of height `most` at (i, j), unwrapped.
    bool compare(int i, int j, float most) {
        if (most <= lowest_) return false;
        const float* du2 = u2_.at(x0_ - i);
        const float* dv2 = v2_.at(y0_ - j);
        const float* gu2 = gap2(u2_, x0_, tile_w, i, i);
        const float* gv2 = gap2(v2_, y0_, tile_h, j, j);
        const float least = std::min(gu2[0], gu2[tile_w - 1]) + std::min(gv2[0], gv2[tile_h - 1]);
        if (least >= widest_ * (most - lowest_) * (most - lowest_)) return false;
        if (!any_within(most, du2, dv2)) return false;
        for (int c = 0; c < tile_columns; ++c) {
            const FourLanes u = four_from(du2 + c * lanes);
            for (int r = 0; r < tile_h; ++r) {
                const FourLanes rise = most - apex_[r][c];
                const FourMask within = (u + dv2[r] < bound_[r][c] * rise * rise) & (rise > 0.0f);
                if (!any(within)) continue;
                const FourLanes q = (u + dv2[r]) / (rise * rise);
                const FourMask less = (q < q_[r][c]) & (rise > 0.0f);
                q_[r][c] = less ? q : q_[r][c];
                bound_[r][c] = less ? q * slack : bound_[r][c];
            }
        }
        return true;
    }

    void tighten() {
        FourLanes widest{};
        for (int r = 0; r < tile_h; ++r)
            for (int c = 0; c < tile_columns; ++c) widest = bound_[r][c] > widest ? bound_[r][c] : widest;
        widest_ = std::max(std::max(widest[0], widest[1]), std::max(widest[2], widest[3]));
    }

    const std::vector<ImageF>& maxima_;
    const SquaredDistances& u2_;
    const SquaredDistances& v2_;
    int width_, height_;
    std::vector<Node> open_;

    int x0_ = 0, y0_ = 0;
    FourLanes apex_[tile_h][tile_columns];   // heights of the tile's texels
    FourLanes q_[tile_h][tile_columns];      // least d2 / rise^2 so far
    FourLanes bound_[tile_h][tile_columns];  // the same, widened by `slack`; 0 in lanes beyond the map
    float lowest_ = 0;             // of apex_
    float widest_ = 0;             // of bound_
};

}  // namespace

ImageF cone_map(const HeightField& field, int threads, const Progress& progress) {
    const int width = field.width();
    const int height = field.height();
    const SquaredDistances u2(width);
    const SquaredDistances v2(height);
    const std::vector<ImageF> maxima = texel_maxima(field.texels, leaf_level + 1, threads);
    ImageF cones(width, height, 2);
    parallel_for((height + tile_h - 1) / tile_h, 1, threads, [&](int begin, int end) {
        TileSearch search(maxima, u2, v2);
        for (int row = begin; row < end; ++row)
            for (int x = 0; x < width; x += tile_w) search.run(x, row * tile_h, cones);
    }, progress, "cone map");
    return cones;
}

}  // namespace relievo
