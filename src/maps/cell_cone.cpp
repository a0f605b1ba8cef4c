#include "maps/cell_cone.h"

#include "core/map_set.h"
#include "core/parallel_for.h"
#include "maps/box_maximum.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

// For every cell Q of height M the largest slope K = rise / distance of the field, seen from Q; c = 1 / K.
//
// The cells within two of Q are bounded one by one. A farther cell is bounded through its corners: let r_i be their distances from Q
// and r(p) that of a point p between them. Along an axis the gap to Q is linear in every cell beside it, so the bilinear blend of the
// r_i^2 exceeds r(p)^2 by a (1-a) du^2 + b (1-b) dv^2, at most k = (du^2 + dv^2) / 4; and since the square root is concave, the
// blend of the sqrt(r_i^2 - k) is at most r(p). So if every corner obeys  h_i - M <= K sqrt(r_i^2 - k),  every point obeys
// h(p) - M <= K r(p): it is enough to look at texels, each a little nearer than it is.
//
// The search is branch and bound over a pyramid of texel maxima, for all cells of a small tile together, so that the walk is paid
// once a tile and the tests run in SIMD lanes; nearest nodes first. A node of distance d is closed once  rise^2 <= d^2 K^2.

namespace relievo {

namespace {

constexpr int tile = 8;        // cells a side; a row of the tile is one vector
constexpr int leaf_level = 2;  // blocks of 4x4 texels are compared texel by texel
constexpr int near_ring = 2;   // cells this far away are bounded one by one
constexpr int patch = tile + 2 * near_ring + 1;

// Eight lanes under GCC's and Clang's vector extension; a machine with narrower registers takes two. Left to themselves the
// compilers vectorise these loops in some surroundings and not in others.
using Lanes = float __attribute__((vector_size(4 * tile)));
using LaneMask = std::int32_t __attribute__((vector_size(4 * tile)));

#define RELIEVO_INLINE inline __attribute__((always_inline))

RELIEVO_INLINE void load(Lanes& v, const float* from) { std::memcpy(&v, from, sizeof v); }
RELIEVO_INLINE bool any(const LaneMask& mask) {
    std::uint64_t part[tile / 2];
    std::memcpy(part, &mask, sizeof part);
    return ((part[0] | part[1]) | (part[2] | part[3])) != 0;
}
RELIEVO_INLINE void raise(Lanes& to, const Lanes& v) { to = v > to ? v : to; }

// Tests compare products with squares instead of dividing; this much less never closes a node that the division would have opened.
constexpr float slack = 1.0f - 0x1p-20f;
// What roundings of 2^-24 can have taken from a slope, twice over.
constexpr float rounding = 1.0f + 0x1p-19f;

// UV units per texel, and how corners stand for what is between them.
struct Metric {
    float du, dv;
    // Subtracted from a texel's squared distance: the k above. It has to stay well below the distances it is taken from, which are at
    // least two texels; where texels are much longer than wide a texel counts as near as the nearest point of its cells instead, and
    // k is 0.
    float nearer;
    int step;  // texels taken off each gap: 0, or 1 in the second case

    Metric(int width, int height) : du(1.0f / static_cast<float>(width)), dv(1.0f / static_cast<float>(height)) {
        const float shorter = std::min(du, dv);
        const float k = 0.25f * (du * du + dv * dv);
        const bool near_square = k < 2 * shorter * shorter;
        nearer = near_square ? k : 0.0f;
        step = near_square ? 0 : 1;
    }
};

// (gap * unit)^2 between a cell and texels `cell - texel` = d, d + 1, d + 2 ... along one axis, unwrapped; d takes either sign.
class SquaredGaps {
public:
    SquaredGaps(int size, float unit, int step) : zero_(2 * size + 2 * tile), table_(static_cast<std::size_t>(2 * zero_ + 1)) {
        for (int d = -zero_; d <= zero_; ++d) {
            const int gap = std::max(0, (d >= 0 ? d : -d - 1) - step);  // texel cell + 1 is the cell's own corner too
            const float uv = static_cast<float>(gap) * unit;
            table_[static_cast<std::size_t>(d + zero_)] = uv * uv;
        }
    }
    const float* at(int d) const { return table_.data() + (d + zero_); }

private:
    int zero_;
    std::vector<float> table_;
};

// Largest texel of blocks of 2^k x 2^k texels, up to a single node; sizes rounded up.
std::vector<ImageF> texel_maxima(const ImageF& texels, int threads) {
    std::vector<ImageF> levels{texels};
    while (levels.back().width > 1 || levels.back().height > 1 || static_cast<int>(levels.size()) <= leaf_level) {
        const ImageF& from = levels.back();
        ImageF to((from.width + 1) / 2, (from.height + 1) / 2, 1);
        parallel_for(to.height, 64, threads, [&](int begin, int end) {
            for (int j = begin; j < end; ++j)
                for (int i = 0; i < to.width; ++i) {
                    const int i1 = std::min(2 * i + 1, from.width - 1);
                    const int j1 = std::min(2 * j + 1, from.height - 1);
                    to(i, j) = std::max(std::max(from(2 * i, 2 * j), from(i1, 2 * j)), std::max(from(2 * i, j1), from(i1, j1)));
                }
        });
        levels.push_back(std::move(to));
    }
    return levels;
}

// Raises `to` to the largest squared slope of a height that goes linearly from n at t0 to f at t1 = t0 + unit, seen over
// sqrt(t^2 + e2). The steepest point inside is t = b e2 / a, where the squared slope is a^2 / e2 + b^2.
RELIEVO_INLINE void steepest(Lanes& to, const Lanes& n, const Lanes& f, float t0, float unit, float e2) {
    const float t1 = t0 + unit;
    const float near2 = t0 * t0 + e2;
    const float far2 = t1 * t1 + e2;
    const Lanes zero{};
    if (near2 > 0) raise(to, n > zero ? n * n * (1 / near2) : zero);
    raise(to, f > zero ? f * f * (1 / far2) : zero);
    if (e2 > 0) {
        const Lanes b = (f - n) * (1 / unit);
        const Lanes a = n - b * t0;
        const Lanes foot = b * e2;
        const LaneMask inside = (a > zero) & (foot > a * t0) & (foot < a * t1);
        raise(to, inside ? a * a * (1 / e2) + b * b : zero);
    }
}

// Whole numbers of 1/65535, as floats: not below and not above.
float rounded_up(float x) {
    int k = static_cast<int>(std::ceil(x * 65535.0 - 0.01));  // the float next to k/65535 may lie on either side of it
    while (static_cast<float>(k / 65535.0) < x) ++k;
    return static_cast<float>(k / 65535.0);
}
float rounded_down(float x) {
    int k = static_cast<int>(std::floor(x * 65535.0));
    while (static_cast<float>(k / 65535.0) > x) --k;
    return static_cast<float>(std::max(k, 1) / 65535.0);  // no cone of a side of 16384 is narrower
}

struct Node {
    int level, i, j;         // in the pyramid
    int origin_x, origin_y;  // of the repeat it is taken from, texels
};

class TileSearch {
public:
    TileSearch(const std::vector<ImageF>& maxima, const Metric& metric, const SquaredGaps& u2, const SquaredGaps& v2)
        : maxima_(maxima), metric_(metric), u2_(u2), v2_(v2), width_(maxima[0].width), height_(maxima[0].height) {
        const float gap = 1.5f - static_cast<float>(metric.step);  // between the gaps of 1 and of 2
        far_u2_ = gap * metric.du * gap * metric.du;
        far_v2_ = gap * metric.dv * gap * metric.dv;
    }

    // Finds M and c of the cells of the tile whose first cell is (x0, y0), and writes them.
    RELIEVO_INLINE void run(int x0, int y0, ImageF& cones) {
        x0_ = x0;
        y0_ = y0;
        gather_patch();
        near_cells();
        search();
        for (int r = 0; r < tile && y0 + r < height_; ++r)
            for (int c = 0; c < tile && x0 + c < width_; ++c) {
                const float k2 = slope2_[r][c];
                float* out = cones.at(x0 + c, y0 + r);
                out[0] = rounded_up(apex_[r][c]);
                out[1] = rounded_down(k2 > 1 ? 1 / (std::sqrt(k2) * rounding) : 1.0f);
            }
    }

private:
    // The texels round the tile, and the larger of every two neighbours.
    RELIEVO_INLINE void gather_patch() {
        const ImageF& texels = maxima_[0];
        for (int j = 0; j < patch; ++j) {
            const float* row = texels.at(0, wrap_index(y0_ + j - near_ring, height_));
            for (int i = 0; i < patch; ++i) texel_[j][i] = row[wrap_index(x0_ + i - near_ring, width_)];
        }
        for (int j = 0; j < patch; ++j)
            for (int i = 0; i + 1 < patch; ++i) pair_x_[j][i] = std::max(texel_[j][i], texel_[j][i + 1]);
        for (int j = 0; j + 1 < patch; ++j)
            for (int i = 0; i < patch; ++i) pair_y_[j][i] = std::max(texel_[j][i], texel_[j + 1][i]);
        lowest_ = 2;
        for (int r = 0; r < tile; ++r) {
            Lanes low;
            load(low, pair_x_[r + near_ring] + near_ring);
            load(apex_[r], pair_x_[r + near_ring + 1] + near_ring);
            raise(apex_[r], low);
            for (int c = 0; c < tile; ++c) {
                // Lanes beyond the map stand above everything, so nothing ever limits them.
                if (x0_ + c >= width_ || y0_ + r >= height_) apex_[r][c] = 2.0f;
                lowest_ = std::min(lowest_, static_cast<float>(apex_[r][c]));
            }
        }
    }

    // Cells within two: along an axis where the cell lies beside Q, the larger of its two columns stands for each of them; with two
    // such axes the smaller slope of both is still a bound. A cell that touches Q in a corner, where it is at most M, is exact:
    // the slope along a ray from the corner is linear, so it is steepest at the corner or on one of the two far edges.
    RELIEVO_INLINE void near_cells() {
        for (int r = 0; r < tile; ++r) {
            Lanes k2{};
            const Lanes m = apex_[r];
            const Lanes zero{};
            for (int oy = -near_ring; oy <= near_ring; ++oy)
                for (int ox = -near_ring; ox <= near_ring; ++ox) {
                    if (ox == 0 && oy == 0) continue;
                    const int near_x = near_ring + (ox > 0 ? ox : ox + 1);
                    const int far_x = near_ring + (ox > 0 ? ox + 1 : ox);
                    const int near_y = r + near_ring + (oy > 0 ? oy : oy + 1);
                    const int far_y = r + near_ring + (oy > 0 ? oy + 1 : oy);
                    const float gap_x = static_cast<float>(std::max(0, std::abs(ox) - 1)) * metric_.du;
                    const float gap_y = static_cast<float>(std::max(0, std::abs(oy) - 1)) * metric_.dv;
                    Lanes cell{};
                    if (std::abs(ox) == 1 && std::abs(oy) == 1) {
                        Lanes a, b, d;
                        load(a, texel_[near_y] + far_x);
                        load(b, texel_[far_y] + near_x);
                        load(d, texel_[far_y] + far_x);
                        a = a > m ? a - m : zero;
                        b = b > m ? b - m : zero;
                        d -= m;
                        const float u2 = metric_.du * metric_.du;
                        const float v2 = metric_.dv * metric_.dv;
                        cell = a * a * (1 / u2) + b * b * (1 / v2);
                        steepest(cell, a, d, 0, metric_.dv, u2);
                        steepest(cell, b, d, 0, metric_.du, v2);
                    } else {
                        Lanes other{};
                        if (ox != 0) {
                            Lanes n, f;
                            load(n, pair_y_[r + near_ring + oy] + near_x);
                            load(f, pair_y_[r + near_ring + oy] + far_x);
                            steepest(cell, n - m, f - m, gap_x, metric_.du, gap_y * gap_y);
                        }
                        if (oy != 0) {
                            Lanes n, f;
                            load(n, pair_x_[near_y] + near_ring + ox);
                            load(f, pair_x_[far_y] + near_ring + ox);
                            steepest(other, n - m, f - m, gap_y, metric_.dv, gap_x * gap_x);
                        }
                        if (ox == 0) cell = other;
                        else if (oy != 0) cell = other < cell ? other : cell;
                    }
                    raise(k2, cell);
                }
            // Flatter than 1 is as good as 1.
            raise(k2, zero + 1.0f);
            slope2_[r] = k2;
            bound_[r] = k2 * slack;
        }
        loosen();
    }

    RELIEVO_INLINE void search() {
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
    RELIEVO_INLINE const float* gaps(const SquaredGaps& squared, int first, int low, int high) const {
        static constexpr float none[tile] = {};
        if (first + tile <= low) return squared.at(first - low);
        if (first > high) return squared.at(first - high);
        return none;
    }

    RELIEVO_INLINE bool may_limit(const Node& n) const {
        const float most = maxima_[static_cast<std::size_t>(n.level)](n.i, n.j);
        if (most <= lowest_) return false;
        const int low_x = n.origin_x + (n.i << n.level);
        const int low_y = n.origin_y + (n.j << n.level);
        const int high_x = n.origin_x + std::min(width_, (n.i + 1) << n.level) - 1;
        const int high_y = n.origin_y + std::min(height_, (n.j + 1) << n.level) - 1;
        const float* du2 = gaps(u2_, x0_, low_x, high_x);
        const float* dv2 = gaps(v2_, y0_, low_y, high_y);
        const float least = std::min(du2[0], du2[tile - 1]) + std::min(dv2[0], dv2[tile - 1]) - metric_.nearer;
        const float highest_rise = most - lowest_;
        if (highest_rise * highest_rise <= least * flattest_) return false;
        Lanes u;
        load(u, du2);
        u -= metric_.nearer;
        const Lanes zero{};
        LaneMask within{};
        for (int r = 0; r < tile; ++r) {
            const Lanes rise = most - apex_[r];
            within |= ((u + dv2[r]) * bound_[r] < rise * rise) & (rise > zero);
        }
        return any(within);
    }

    RELIEVO_INLINE void compare_block(const Node& n) {
        const int end_x = std::min(width_, (n.i + 1) << n.level);
        const int end_y = std::min(height_, (n.j + 1) << n.level);
        bool changed = false;
        for (int j = n.j << n.level; j < end_y; ++j)
            for (int i = n.i << n.level; i < end_x; ++i) changed |= compare(n.origin_x + i, n.origin_y + j, maxima_[0](i, j));
        if (changed) loosen();
    }

    // The tile's cells against the texel of height `most` at (i, j), unwrapped.
    RELIEVO_INLINE bool compare(int i, int j, float most) {
        if (most <= lowest_) return false;
        const float* gu2 = gaps(u2_, x0_, i, i);
        const float* gv2 = gaps(v2_, y0_, j, j);
        const float least = std::min(gu2[0], gu2[tile - 1]) + std::min(gv2[0], gv2[tile - 1]) - metric_.nearer;
        if ((most - lowest_) * (most - lowest_) <= least * flattest_) return false;
        const float* dv2 = v2_.at(y0_ - j);
        Lanes u;
        load(u, u2_.at(x0_ - i));
        // Texels one away along both axes belong to the cells within two only.
        const LaneMask far_x = u > far_u2_;
        u -= metric_.nearer;
        const Lanes zero{};
        bool changed = false;
        for (int r = 0; r < tile; ++r) {
            const Lanes d2 = u + dv2[r];
            const Lanes rise = most - apex_[r];
            const Lanes rise2 = rise * rise;
            LaneMask within = (d2 * bound_[r] < rise2) & (rise > zero);
            if (!(dv2[r] > far_v2_)) within &= far_x;
            if (!any(within)) continue;
            const Lanes k2 = rise2 / d2;
            const LaneMask more = within & (k2 > slope2_[r]);
            slope2_[r] = more ? k2 : slope2_[r];
            bound_[r] = slope2_[r] * slack;
            changed = true;
        }
        return changed;
    }

    RELIEVO_INLINE void loosen() {
        Lanes flattest = bound_[0];
        for (int r = 0; r < tile; ++r) {
            // Lanes beyond the map limit nothing.
            const Lanes mine = apex_[r] > 1.5f ? flattest : bound_[r];
            flattest = mine < flattest ? mine : flattest;
        }
        flattest_ = flattest[0];
        for (int c = 1; c < tile; ++c) flattest_ = std::min(flattest_, static_cast<float>(flattest[c]));
    }

    const std::vector<ImageF>& maxima_;
    const Metric& metric_;
    const SquaredGaps& u2_;
    const SquaredGaps& v2_;
    int width_, height_;
    float far_u2_, far_v2_;  // squared gaps above these are of two texels or more
    std::vector<Node> open_;

    int x0_ = 0, y0_ = 0;
    float texel_[patch][patch + tile] = {};   // from `near_ring` before the tile
    float pair_x_[patch][patch + tile] = {};  // of texels i, i + 1
    float pair_y_[patch][patch + tile] = {};  // of texels j, j + 1
    Lanes apex_[tile];    // M of the tile's cells
    Lanes slope2_[tile];  // largest squared slope so far
    Lanes bound_[tile];   // the same, less `slack`
    float lowest_ = 0;    // of apex_
    float flattest_ = 0;  // of bound_
};

struct Bake {
    const std::vector<ImageF>& maxima;
    const Metric& metric;
    const SquaredGaps& u2;
    const SquaredGaps& v2;
    ImageF& cones;
};

RELIEVO_INLINE void bake_rows(const Bake& b, int begin, int end) {
    TileSearch search(b.maxima, b.metric, b.u2, b.v2);
    for (int row = begin; row < end; ++row)
        for (int x = 0; x < b.cones.width; x += tile) search.run(x, row * tile, b.cones);
}

// One body, compiled for what the processor may have. Neither contracts products into sums, so that the bits are the same.
void bake_rows_plain(const Bake& b, int begin, int end) { bake_rows(b, begin, end); }
#if defined(__x86_64__)
__attribute__((target("avx2"))) void bake_rows_avx2(const Bake& b, int begin, int end) { bake_rows(b, begin, end); }
#endif

}  // namespace

ImageF cell_cone_map(const HeightField& field, int threads, const Progress& progress) {
    const int width = field.width();
    const int height = field.height();
    const Metric metric(width, height);
    const SquaredGaps u2(width, metric.du, metric.step);
    const SquaredGaps v2(height, metric.dv, metric.step);
    const std::vector<ImageF> maxima = texel_maxima(field.texels, threads);
    ImageF cones(width, height, 4);
    const Bake bake{maxima, metric, u2, v2, cones};
    auto* rows = &bake_rows_plain;
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2")) rows = &bake_rows_avx2;
#endif
    parallel_for((height + tile - 1) / tile, 1, threads, [&](int begin, int end) { rows(bake, begin, end); }, progress, "cell cone map");

    ImageF highest(width, height, 1);
    for (std::size_t i = 0; i < highest.texels.size(); ++i) highest.texels[i] = cones.texels[4 * i];
    const ImageF near_roof = box_maximum(highest, near_roof_reach, threads);
    const ImageF far_roof = box_maximum(highest, far_roof_reach, threads);
    for (std::size_t i = 0; i < highest.texels.size(); ++i) {
        cones.texels[4 * i + 2] = near_roof.texels[i];
        cones.texels[4 * i + 3] = far_roof.texels[i];
    }
    return cones;
}

}  // namespace relievo
