// The search that all cone maps share: for every texel, over the repeated field, the largest squared slope that a rule finds.
// Branch and bound over a pyramid of texel maxima; all texels of a tile search together, so that the walk is paid once a tile and
// the tests run in SIMD lanes, nearest nodes first, so that the bound is high when far ones are met.
//
// What is within a few texels of a lane decides most cones of rough fields, and is taken first, at the same offset in every lane:
// its distances are constants there. Then what limited the tile before, which mostly limits this one too. Both close most nodes.
//
// Included once for every kind of machine (core/each_machine.h), in its namespace: no include guard.

#include "maps/cone_lanes.h"

namespace relievo::cone_search::RELIEVO_MACHINE {

// A cell's first corner as several texels see it: places in texels from them, and their own heights.
struct Seen {
    Lanes dx, dy;
    Lanes apex;
};
struct Corners {
    Lanes h00, h10, h01, h11;
};

// Rule: what texels and cells do to a cone.
//   static constexpr bool directional, static Octants octants(...)  as in cone_search.h
//   ring                                                            texels up to which `near` has done all cells
template <class Rule>
class Search {
    // Lanes of a group are a block of texels, as compact as may be, so that they agree on most nodes.
    static constexpr int group_w = 4;
    static constexpr int group_h = lane_count / group_w;
    static constexpr int halves = tile / group_w;
    static constexpr int groups = tile * tile / lane_count;
    static constexpr unsigned all_groups = (1u << groups) - 1;
    static constexpr int ring = Rule::ring;
    static constexpr int patch = tile + 2 * ring;

public:
    Search(const HeightField& field, const Reach& reach)
        : texels_(field.texels),
          reach_(reach),
          levels_(reach.levels),
          width_(field.width()),
          height_(field.height()),
          metric_(width_, height_),
          near_(metric_) {
        for (int g = 0; g < groups; ++g)
            for (int l = 0; l < lane_count; ++l) {
                lane_x_[g][l] = static_cast<float>(column(g, l));
                lane_y_[g][l] = static_cast<float>(row(g, l));
            }
        for (int k = 0; k < cell_groups; ++k)
            for (int l = 0; l < lane_count; ++l) {
                cell_x_[k][l] = static_cast<float>((k * lane_count + l) % row_bits - 1);
                cell_y_[k][l] = static_cast<float>((k * lane_count + l) / row_bits - 1);
            }
        // Only texels less than `ring` away along both axes are below this; all their cells are near ones.
        const float distance = static_cast<float>(ring) - metric_.step;
        const ImageF& top = levels_.back();
        highest_ = *std::max_element(top.texels.begin(), top.texels.end());
        near2_ = distance * distance * std::min(metric_.u2, metric_.v2) * (1 - 0x1p-10f) - metric_.nearer;
    }

    // Finds the cones of the texels of the tile whose first texel is (x0, y0), and writes height and ratio.
    void run(int x0, int y0, ImageF& cones) {
        x0_ = x0;
        y0_ = y0;
        lowest_ = 2;
        for (int j = 0; j < patch; ++j) {
            const float* from = texels_.at(0, wrap_index(y0 + j - ring, height_));
            if (x0 >= ring && x0 + tile + ring <= width_)
                std::memcpy(patch_[j], from + x0 - ring, patch * sizeof(float));
            else
                for (int i = 0; i < patch; ++i) patch_[j][i] = from[wrap_index(x0 + i - ring, width_)];
        }
        for (int g = 0; g < groups; ++g) {
            apex_[g] = around(g, 0, 0);
            for (int l = 0; l < lane_count; ++l) {
                // Lanes beyond the map stand above everything, so nothing ever limits them.
                if (x0 + column(g, l) >= width_ || y0 + row(g, l) >= height_) apex_[g][l] = 2.0f;
                lowest_ = std::min(lowest_, apex_[g][l]);
            }
            slope2_[g] = least_slope2 + Lanes{};
        }
        if (highest_ > lowest_) search();
        for (int g = 0; g < groups; ++g)
            for (int l = 0; l < lane_count; ++l) {
                const int x = x0 + column(g, l);
                const int y = y0 + row(g, l);
                if (x >= width_ || y >= height_) continue;
                float* to = cones.at(x, y);
                to[0] = apex_[g][l];
                to[1] = slope2_[g][l] > least_slope2 ? std::min(1.0f, rounding_down / std::sqrt(slope2_[g][l])) : 1.0f;
            }
    }

private:
    static constexpr int column(int g, int l) { return g % halves * group_w + l % group_w; }
    static constexpr int row(int g, int l) { return g / halves * group_h + l / group_w; }

    struct Node {
        int level, i, j;         // in the pyramid
        int origin_x, origin_y;  // of the repeat it is taken from, texels
        unsigned groups;         // that it may limit
    };

    void search() {
        for (int g = 0; g < groups; ++g) {
            gather(g);
            slope2_[g] = near_.steepest(around_, apex_[g], metric_);
            set_bound(g);
        }
        loosen();
        kept_ = static_cast<int>(std::min<std::size_t>(steepened_, seed_count));
        for (int k = 0; k < kept_; ++k) seeds_[k] = recent_[(steepened_ - 1 - static_cast<std::size_t>(k)) % seed_count];
        steepened_ = 0;
        for (int k = 0; k < kept_; ++k)
            if (const unsigned open = may_limit(seeds_[k], all_groups)) block(seeds_[k], open);
        descend();
        // Last, for they take longest, and most are beyond what is known by now.
        for (int g = 0; g < groups; ++g) near_insides(g);
    }

    // Heights at an offset from each texel of a group.
    Lanes around(int g, int dx, int dy) const {
        Lanes v;
        for (int r = 0; r < group_h; ++r)
            std::memcpy(reinterpret_cast<char*>(&v) + r * group_w * sizeof(float),
                        &patch_[row(g, 0) + r + dy + ring][column(g, 0) + dx + ring], group_w * sizeof(float));
        return v;
    }

    void descend() {
        const int top = static_cast<int>(levels_.size()) - 1;
        open_.clear();
        for (int b = -1; b <= 1; ++b)
            for (int a = -1; a <= 1; ++a)
                if (a != 0 || b != 0) open_.push_back({top, 0, 0, a * width_, b * height_, all_groups});
        open_.push_back({top, 0, 0, 0, 0, all_groups});
        while (!open_.empty()) {
            const Node n = open_.back();
            open_.pop_back();
            const unsigned open = may_limit(n, n.groups);
            if (open == 0) continue;
            if (n.level == leaf_level) {
                block(n, open);
                continue;
            }
            // Nearest child last, so that it is taken first.
            const ImageF& below = levels_[static_cast<std::size_t>(n.level - 1)];
            const int near_i = x0_ >= n.origin_x + ((2 * n.i + 1) << (n.level - 1)) ? 1 : 0;
            const int near_j = y0_ >= n.origin_y + ((2 * n.j + 1) << (n.level - 1)) ? 1 : 0;
            for (int k = 3; k >= 0; --k) {
                const int i = 2 * n.i + (near_i ^ (k & 1));
                const int j = 2 * n.j + (near_j ^ (k >> 1));
                if (i < below.width && j < below.height) open_.push_back({n.level - 1, i, j, n.origin_x, n.origin_y, open});
            }
        }
    }

    // Largest reach of a node of texels [low, high], for the quadrants in which the tile sees it.
    float reach_of(const float* reach, int low_x, int high_x, int low_y, int high_y) const {
        if constexpr (!Rule::directional) {
            return reach[0];
        } else {
            // A texel in line with another is a corner of cells on both sides of it.
            const bool right = high_x >= x0_;
            const bool left = low_x < x0_ + tile;
            const bool up = high_y >= y0_;
            const bool down = low_y < y0_ + tile;
            float all = -1;
            if (right && up) all = std::max(all, reach[0]);
            if (left && up) all = std::max(all, reach[1]);
            if (right && down) all = std::max(all, reach[2]);
            if (left && down) all = std::max(all, reach[3]);
            return all;
        }
    }

    static float gap(int first, int low, int high) {
        return static_cast<float>(std::max(0, std::max(low - (first + tile - 1), first - high)));
    }

    void gather(int g) {
        for (int j = 0; j <= 2 * ring; ++j)
            for (int i = 0; i <= 2 * ring; ++i) around_[j][i] = around(g, i - ring, j - ring);
    }

    // The insides of all cells up to `ring` texels from each texel of a group.
    void near_insides(int g) {
        gather(g);
        Lanes k2 = slope2_[g];
        for (int j = -ring; j < ring; ++j)
            for (int i = -ring; i < ring; ++i) {
                const Lanes* low = &around_[j + ring][i + ring];
                const Lanes* high = &around_[j + ring + 1][i + ring];
                const Corners c{low[0], low[1], high[0], high[1]};
                const Seen seen{static_cast<float>(i) + Lanes{}, static_cast<float>(j) + Lanes{}, apex_[g]};
                search_inside(c, seen, k2);
            }
        slope2_[g] = k2;
    }

    // The groups that a node may limit, of those asked for.
    unsigned may_limit(const Node& n, unsigned asked) const {
        const int low_x = n.origin_x + (n.i << n.level);
        const int low_y = n.origin_y + (n.j << n.level);
        const int high_x = n.origin_x + std::min(width_, (n.i + 1) << n.level) - 1;
        const int high_y = n.origin_y + std::min(height_, (n.j + 1) << n.level) - 1;
        const float top = reach_of(levels_[static_cast<std::size_t>(n.level)].at(n.i, n.j), low_x, high_x, low_y, high_y);
        if (top <= lowest_) return 0;
        const float gx = std::max(0.0f, gap(x0_, low_x, high_x) - metric_.step);
        const float gy = std::max(0.0f, gap(y0_, low_y, high_y) - metric_.step);
        const float rise = top - lowest_;
        const float nearest2 = gx * gx * metric_.u2 + gy * gy * metric_.v2;
        if ((nearest2 - metric_.nearer) * flattest_ >= rise * rise) return 0;
        if (metric_.step == 0.0f && nearest2 >= std::min(metric_.u2, metric_.v2)) {
            const Sheet sheet = sheet_of(n, low_x, high_x, low_y, high_y, std::sqrt(nearest2));
            // Above a rough node the plane is nowhere much lower than the highest texel.
            if (sheet.height < top) return groups_where(asked, [&](int g) { return rises_above(sheet, g); });
        }
        return groups_where(asked, [&](int g) {
            const Lanes above = most(top - apex_[g], Lanes{});
            return any_less(bound_[g] * squared_gap(g, low_x, high_x, low_y, high_y), above * above);
        });
    }

    // Of the groups asked for, those that a test holds for.
    template <class Test>
    static unsigned groups_where(unsigned asked, const Test& test) {
        unsigned open = 0;
        for (; asked != 0; asked &= asked - 1) {
            const int g = std::countr_zero(asked);
            if (test(g)) open |= 1u << g;
        }
        return open;
    }

    // A node's part of the plane above it.
    struct Sheet {
        float x, y, half_x, half_y;    // texels, its middle from the tile's first texel on
        float height, step_x, step_y;  // in the middle; a texel
        float lost;                    // of distances, UV: see rises_above
    };
    Sheet sheet_of(const Node& n, int low_x, int high_x, int low_y, int high_y, float nearest) const {
        const float* plane = reach_.planes[static_cast<std::size_t>(n.level - leaf_level)].at(n.i, n.j);
        Sheet s;
        s.half_x = 0.5f * static_cast<float>(high_x - low_x);
        s.half_y = 0.5f * static_cast<float>(high_y - low_y);
        s.x = static_cast<float>(low_x - x0_) + s.half_x;
        s.y = static_cast<float>(low_y - y0_) + s.half_y;
        s.step_x = plane[1];
        s.step_y = plane[2];
        s.height = plane[0] + s.step_x * s.half_x + s.step_y * s.half_y;
        // Some ten roundings of 2^-24 of what is added up.
        s.lost = metric_.nearer / nearest + 0x1p-18f * (nearest + static_cast<float>(2 * tile + 2 * s.half_x) * metric_.du +
                                                        static_cast<float>(2 * tile + 2 * s.half_y) * metric_.dv);
        return s;
    }

    // Whether the plane above a node rises above the cone of a lane. The distance r of a place p from the apex a is at least its
    // part along any direction e, e (p - a), and sqrt(r^2 - nearer) at least r - nearer / r. So every texel's height less its
    // cone's is at most a linear function of its place, which is largest in a corner of the node. With the direction of the node's
    // middle, nothing is left of its size where it faces the apex with a slope like the cone's.
    bool rises_above(const Sheet& s, int g) const {
        const Lanes x = s.x - lane_x_[g];
        const Lanes y = s.y - lane_y_[g];
        const Lanes distance = root(x * x * metric_.u2 + y * y * metric_.v2);
        const Lanes slope = root_[g] / distance;
        const Lanes spread =
            magnitude(s.step_x - x * metric_.u2 * slope) * s.half_x + magnitude(s.step_y - y * metric_.v2 * slope) * s.half_y;
        return any_less(root_[g] * (distance - s.lost), s.height + 0x1p-18f - apex_[g] + spread);
    }

    void set_bound(int g) {
        bound_[g] = slope2_[g] * slack;
        root_[g] = root(bound_[g]);
    }

    Lanes squared_gap(int g, int low_x, int high_x, int low_y, int high_y) const {
        return gap2(lane_x_[g], low_x - x0_, high_x - x0_) * metric_.u2 +
               (gap2(lane_y_[g], low_y - y0_, high_y - y0_) * metric_.v2 - metric_.nearer);
    }
    // Squared texels between places and [low, high].
    Lanes gap2(Lanes place, int low, int high) const {
        const Lanes d =
            most(most(static_cast<float>(low) - metric_.step - place, place - (static_cast<float>(high) + metric_.step)), Lanes{});
        return d * d;
    }

    // Cells and texels of a leaf as bits: 8 a row, the cell or texel that is i right of and j above the first one at 8 j + i. Cells
    // begin a texel before the leaf's first one.
    using Bits = std::uint64_t;
    static constexpr int row_bits = 8;
    static constexpr int leaf_size = 1 << leaf_level;
    static constexpr int leaf_cells = row_bits * (leaf_size + 1);
    static constexpr int cell_groups = (leaf_cells + lane_count - 1) / lane_count;
    static_assert(leaf_size + 2 <= row_bits && leaf_cells <= 64);

    static constexpr Bits block_bits(int count_x, int count_y) {
        Bits all = 0;
        for (int j = 0; j < count_y; ++j) all |= ((Bits{1} << count_x) - 1) << (row_bits * j);
        return all;
    }

    // The corners of a leaf's cells, row_bits a row.
    struct Leaf {
        int x, y;              // its first texel, from the tile's first one on
        int count_x, count_y;  // texels
        float height[row_bits * (leaf_size + 2) + 2 * lane_count];
    };

    void read(const Node& n, Leaf& leaf) const {
        const int first_x = n.i << n.level;
        const int first_y = n.j << n.level;
        leaf.x = n.origin_x + first_x - x0_;
        leaf.y = n.origin_y + first_y - y0_;
        leaf.count_x = std::min(width_ - first_x, leaf_size);
        leaf.count_y = std::min(height_ - first_y, leaf_size);
        const bool whole = first_x > 0 && first_x + leaf_size < width_;
        for (int j = 0; j <= leaf.count_y + 1; ++j) {
            int y = first_y + j - 1;
            y = y < 0 ? y + height_ : y >= height_ ? y - height_ : y;
            const float* from = texels_.at(0, y);
            float* to = leaf.height + row_bits * j;
            if (whole)
                std::memcpy(to, from + first_x - 1, (leaf_size + 2) * sizeof(float));
            else
                for (int i = 0; i <= leaf.count_x + 1; ++i) to[i] = from[wrap_index(first_x + i - 1, width_)];
        }
    }

    // The cells of a leaf that may fall, seen from the texels [x, x + w] x [y, y + h] of the tile.
    Bits falling(const Leaf& leaf, int x, int y, int w, int h) const {
        Bits cells = 0;
        for (int k = 0; k < cell_groups; ++k) {
            const auto at = [&](int offset) {
                Lanes v;
                std::memcpy(&v, leaf.height + k * lane_count + offset, sizeof v);
                return v;
            };
            const Corners c{at(0), at(1), at(row_bits), at(row_bits + 1)};
            const Lanes low_x = cell_x_[k] + static_cast<float>(leaf.x - x - w);
            const Lanes low_y = cell_y_[k] + static_cast<float>(leaf.y - y - h);
            cells |=
                Bits{bits_of(Rule::falls(c, low_x, low_x + static_cast<float>(w + 1), low_y, low_y + static_cast<float>(h + 1)))}
                << (k * lane_count);
        }
        return cells & block_bits(leaf.count_x + 1, leaf.count_y + 1);
    }

    void block(const Node& n, unsigned asked) {
        Leaf leaf;
        read(n, leaf);
        Bits cells_asked = block_bits(leaf.count_x + 1, leaf.count_y + 1);
        Bits texels_asked = block_bits(leaf.count_x, leaf.count_y);
        if constexpr (Rule::directional) {
            cells_asked = falling(leaf, 0, 0, tile - 1, tile - 1);
            if (cells_asked == 0) return;
            texels_asked &= cells_asked | cells_asked >> 1 | cells_asked >> row_bits | cells_asked >> (row_bits + 1);
        }
        bool changed = false;
        for (int g = 0; g < groups; ++g) {
            if ((asked & (1u << g)) == 0) continue;
            Lanes x2[leaf_size], y2[leaf_size];
            for (int i = 0; i < leaf_size; ++i) {
                x2[i] = gap2(lane_x_[g], leaf.x + i, leaf.x + i) * metric_.u2;
                y2[i] = gap2(lane_y_[g], leaf.y + i, leaf.y + i) * metric_.v2 - metric_.nearer;
            }
            Bits hits = 0;
            for (Bits open = texels_asked; open != 0; open &= open - 1) {
                const int k = std::countr_zero(open);
                const int i = k % row_bits;
                const int j = k / row_bits;
                const Lanes above = most(leaf.height[k + row_bits + 1] - apex_[g], Lanes{});
                const Lanes d2 = x2[i] + y2[j];
                if (!any_less(bound_[g] * d2, above * above)) continue;
                if (!any((bound_[g] * d2 < above * above) & (d2 >= near2_))) continue;
                const Lanes dx = static_cast<float>(leaf.x + i) - lane_x_[g];
                const Lanes dy = static_cast<float>(leaf.y + j) - lane_y_[g];
                Rule::texel(dx * dx * metric_.u2 + dy * dy * metric_.v2, above, slope2_[g]);
                set_bound(g);
                hits |= Bits{1} << k;
            }
            if (hits != 0) changed |= cells(leaf, g, cells_asked & (hits | hits << 1 | hits << row_bits | hits << (row_bits + 1)));
        }
        if (!changed) return;
        loosen();
        recent_[steepened_++ % seed_count] = n;
    }

    bool cells(const Leaf& leaf, int g, Bits asked) {
        if constexpr (Rule::directional) asked &= falling(leaf, column(g, 0), row(g, 0), group_w - 1, group_h - 1);
        const Lanes before = slope2_[g];
        for (Bits open = asked; open != 0; open &= open - 1) {
            const int k = std::countr_zero(open);
            const float* corner = leaf.height + k;
            const Lanes none{};
            const Corners c{corner[0] + none, corner[1] + none, corner[row_bits] + none, corner[row_bits + 1] + none};
            const Seen seen{static_cast<float>(leaf.x + k % row_bits - 1) - lane_x_[g],
                            static_cast<float>(leaf.y + k / row_bits - 1) - lane_y_[g], apex_[g]};
            Rule::edges(c, seen, metric_, slope2_[g]);
            search_inside(c, seen, slope2_[g]);
        }
        set_bound(g);
        return any_less(before, slope2_[g]);
    }

    void search_inside(const Corners& c, const Seen& seen, Lanes& k2) {
        const std::uint32_t exceeding = may_exceed(c, seen, k2);
        if (exceeding == 0) return;
        const std::uint32_t inside = exceeding & bits_of(Rule::may_bind_inside(c, seen, metric_, k2));
        if (inside != 0) search_inside(c, seen, inside, k2);
    }

    // The lanes for which a point of a cell may be steeper than k2, by its corners (Metric).
    std::uint32_t may_exceed(const Corners& c, const Seen& seen, Lanes k2) const {
        const Lanes x0 = gap2(seen.dx, 0, 0) * metric_.u2;
        const Lanes x1 = gap2(seen.dx, -1, -1) * metric_.u2;
        const Lanes y0 = gap2(seen.dy, 0, 0) * metric_.v2 - metric_.nearer;
        const Lanes y1 = gap2(seen.dy, -1, -1) * metric_.v2 - metric_.nearer;
        const Lanes bound = k2 * slack;
        const auto exceeds = [&](Lanes height, Lanes d2) {
            const Lanes above = most(height - seen.apex, Lanes{});
            return bits_less(bound * d2, above * above);
        };
        return exceeds(c.h00, x0 + y0) | exceeds(c.h10, x1 + y0) | exceeds(c.h01, x0 + y1) | exceeds(c.h11, x1 + y1);
    }

    __attribute__((noinline)) void search_inside(const Corners& c, const Seen& seen, std::uint32_t inside, Lanes& k2) {
        for (; inside != 0; inside &= inside - 1) {
            const int l = std::countr_zero(inside);
            const double apex = seen.apex[l];
            const bool right = seen.dx[l] >= 0;
            const bool up = seen.dy[l] >= 0;
            const double low_near = right ? c.h00[l] : c.h10[l], low_far = right ? c.h10[l] : c.h00[l];
            const double high_near = right ? c.h01[l] : c.h11[l], high_far = right ? c.h11[l] : c.h01[l];
            const Cell turned{(up ? low_near : high_near) - apex,   (up ? low_far : high_far) - apex,
                              (up ? high_near : low_near) - apex,   (up ? high_far : low_far) - apex,
                              right ? seen.dx[l] : -1 - seen.dx[l], up ? seen.dy[l] : -1 - seen.dy[l]};
            k2[l] = std::max(k2[l], static_cast<float>(Rule::inside(turned, metric_, k2[l])));
        }
    }

    void loosen() {
        Lanes flattest = 4e9f + Lanes{};
        // Lanes beyond the map limit nothing.
        for (int g = 0; g < groups; ++g) flattest = least(flattest, apex_[g] > 1.5f ? flattest : bound_[g]);
        flattest_ = flattest[0];
        for (int l = 1; l < lane_count; ++l) flattest_ = std::min(flattest_, flattest[l]);
    }

    const ImageF& texels_;
    const Reach& reach_;
    const std::vector<ImageF>& levels_;
    int width_, height_;
    Metric metric_;
    typename Rule::template Near<ring> near_;
    float near2_;
    float highest_;  // of all that may limit a cone
    std::vector<Node> open_;

    // Blocks in which a cone of this tile got narrower, the latest ones, and what is taken over from the tile before. A row of
    // tiles starts with none, so that the work does not depend on how rows are shared out.
    static constexpr std::size_t seed_count = 8;
    Node recent_[seed_count], seeds_[seed_count];
    std::size_t steepened_ = 0;
    int kept_ = 0;

    int x0_ = 0, y0_ = 0;
    float patch_[patch][patch];                        // heights from `ring` texels before the tile on
    Lanes around_[2 * ring + 1][2 * ring + 1];         // around each texel of a group
    Lanes lane_x_[groups], lane_y_[groups];            // places of the lanes in the tile
    Lanes cell_x_[cell_groups], cell_y_[cell_groups];  // of a leaf's cells, from its first texel on
    Lanes apex_[groups];                               // heights of the tile's texels
    Lanes slope2_[groups];                             // largest squared slope so far
    Lanes bound_[groups];                              // the same, less `slack`
    Lanes root_[groups];                               // square root of that
    float lowest_ = 0;                                 // of apex_
    float flattest_ = 0;                               // of bound_
};

template <class Rule>
void search_rows(const Rows& rows) {
    for (int row = rows.begin; row < rows.end; ++row) {
        Search<Rule> search(rows.field, rows.reach);
        for (int x = 0; x < rows.field.width(); x += tile) search.run(x, row * tile, rows.cones);
    }
}

}  // namespace relievo::cone_search::RELIEVO_MACHINE
