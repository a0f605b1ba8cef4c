// The search that all cone maps share: for every texel, over the repeated field, the largest squared slope that a rule finds.
// Branch and bound over a pyramid of texel maxima; all texels of a tile search together, so that the walk is paid once a tile and
// the tests run in SIMD lanes, nearest nodes first, so that the bound is high when far ones are met.
//
// What is within a few texels of a lane decides most cones of rough fields, and is taken first, at the same offset in every lane:
// its distances are constants there. Then what limited the tile before, which mostly limits this one too. Both close most nodes.
//
// Included once for every kind of machine (core/each_machine.h), in its namespace: no include guard.

namespace relievo::cone_search::RELIEVO_MACHINE {

// Under GCC's and Clang's vector extension, as wide as a register of the machine: wider ones would be taken apart lane by lane.
using Lanes = float __attribute__((vector_size(4 * RELIEVO_LANES)));
using LaneMask = std::int32_t __attribute__((vector_size(4 * RELIEVO_LANES)));
constexpr int lane_count = RELIEVO_LANES;

inline bool any(LaneMask mask) {
#if RELIEVO_LANES == 16
    return __builtin_ia32_cvtd2mask512(mask) != 0;
#elif RELIEVO_LANES == 8
    return __builtin_ia32_movmskps256(reinterpret_cast<Lanes>(mask)) != 0;
#else
    std::uint64_t half[2];
    std::memcpy(half, &mask, sizeof half);
    return (half[0] | half[1]) != 0;
#endif
}
// Compilers take a comparison of 16 lanes into a vector and back before they ask whether any holds.
inline bool any_less(Lanes a, Lanes b) {
#if RELIEVO_LANES == 16
    return __builtin_ia32_cmpps512_mask(a, b, 1, -1, 4) != 0;
#else
    return any(a < b);
#endif
}
inline Lanes least(Lanes a, Lanes b) { return a < b ? a : b; }
inline Lanes most(Lanes a, Lanes b) { return a > b ? a : b; }
inline Lanes magnitude(Lanes a) { return a < 0.0f ? -a : a; }

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
            bound_[g] = slope2_[g] * slack;
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
        if ((gx * gx * metric_.u2 + gy * gy * metric_.v2 - metric_.nearer) * flattest_ >= rise * rise) return 0;
        unsigned open = 0;
        for (int g = 0; g < groups; ++g) {
            if ((asked & (1u << g)) == 0) continue;
            const Lanes above = most(top - apex_[g], Lanes{});
            if (any_less(bound_[g] * squared_gap(g, low_x, high_x, low_y, high_y), above * above)) open |= 1u << g;
        }
        return open;
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

    void block(const Node& n, unsigned asked) {
        const int first_x = n.i << n.level;
        const int first_y = n.j << n.level;
        const int count_x = std::min(width_ - first_x, 1 << leaf_level);
        const int count_y = std::min(height_ - first_y, 1 << leaf_level);
        const int low_x = n.origin_x + first_x;
        const int low_y = n.origin_y + first_y;
        [[maybe_unused]] unsigned octants = 0;
        if constexpr (Rule::directional)
            octants = octants_of(low_x - 1 - (x0_ + tile - 1), low_x + count_x - x0_, low_y - 1 - (y0_ + tile - 1),
                                 low_y + count_y - y0_);
        bool changed = false;
        for (int g = 0; g < groups; ++g) {
            if ((asked & (1u << g)) == 0) continue;
            Lanes x2[1 << leaf_level];
            for (int i = 0; i < count_x; ++i) x2[i] = gap2(lane_x_[g], low_x + i - x0_, low_x + i - x0_) * metric_.u2;
            std::uint32_t hits = 0;  // texels, five a row
            for (int j = 0; j < count_y; ++j) {
                const Lanes y2 = gap2(lane_y_[g], low_y + j - y0_, low_y + j - y0_) * metric_.v2 - metric_.nearer;
                for (int i = 0; i < count_x; ++i) {
                    if constexpr (Rule::directional)
                        if ((reach_.texels[at(first_x + i, first_y + j)] & octants) == 0) continue;
                    const float top = texels_(first_x + i, first_y + j);
                    const Lanes above = most(top - apex_[g], Lanes{});
                    const Lanes d2 = x2[i] + y2;
                    if (!any_less(bound_[g] * d2, above * above)) continue;
                    if (!any((bound_[g] * d2 < above * above) & (d2 >= near2_))) continue;
                    const Lanes dx = static_cast<float>(low_x + i - x0_) - lane_x_[g];
                    const Lanes dy = static_cast<float>(low_y + j - y0_) - lane_y_[g];
                    Rule::texel(dx * dx * metric_.u2 + dy * dy * metric_.v2, above, slope2_[g]);
                    bound_[g] = slope2_[g] * slack;
                    hits |= 1u << (5 * j + i);
                }
            }
            if (hits != 0) changed |= cells(n, g, hits, octants);
        }
        if (!changed) return;
        loosen();
        recent_[steepened_++ % seed_count] = n;
    }

    // The cells that the texels of `hits` are corners of.
    bool cells(const Node& n, int g, std::uint32_t hits, [[maybe_unused]] unsigned octants) {
        const int first_x = (n.i << n.level) - 1;
        const int first_y = (n.j << n.level) - 1;
        const Lanes before = slope2_[g];
        for (std::uint32_t open = hits | hits << 1 | hits << 5 | hits << 6; open != 0; open &= open - 1) {
            const int k = std::countr_zero(open);
            const int i = first_x + k % 5;
            const int j = first_y + k / 5;
            const int wi = i < 0 ? i + width_ : i;
            const int wj = j < 0 ? j + height_ : j;
            const int wi1 = wi + 1 == width_ ? 0 : wi + 1;
            const int wj1 = wj + 1 == height_ ? 0 : wj + 1;
            if constexpr (Rule::directional)
                if ((reach_.cells[at(wi, wj)] & octants) == 0) continue;
            const float corners[4] = {texels_(wi, wj), texels_(wi1, wj), texels_(wi, wj1), texels_(wi1, wj1)};
            if constexpr (Rule::directional) {
                const float x = static_cast<float>(n.origin_x + i - x0_ - column(g, 0));
                const float y = static_cast<float>(n.origin_y + j - y0_ - row(g, 0));
                if (!Rule::falls(corners, x - (group_w - 1), x + 1, y - (group_h - 1), y + 1)) continue;
            }
            const Lanes none{};
            const Corners c{corners[0] + none, corners[1] + none, corners[2] + none, corners[3] + none};
            const Seen seen{static_cast<float>(n.origin_x + i - x0_) - lane_x_[g],
                            static_cast<float>(n.origin_y + j - y0_) - lane_y_[g], apex_[g]};
            Rule::edges(c, seen, metric_, slope2_[g]);
            search_inside(c, seen, slope2_[g]);
        }
        bound_[g] = slope2_[g] * slack;
        return any_less(before, slope2_[g]);
    }

    void search_inside(const Corners& c, const Seen& seen, Lanes& k2) {
        LaneMask inside = may_exceed(c, seen, k2);
        if (!any(inside)) return;
        inside &= Rule::may_bind_inside(c, seen, metric_, k2);
        if (any(inside)) search_inside(c, seen, inside, k2);
    }

    // Whether any point of a cell may be steeper than k2, by its corners (Metric).
    LaneMask may_exceed(const Corners& c, const Seen& seen, Lanes k2) const {
        const Lanes x0 = gap2(seen.dx, 0, 0) * metric_.u2;
        const Lanes x1 = gap2(seen.dx, -1, -1) * metric_.u2;
        const Lanes y0 = gap2(seen.dy, 0, 0) * metric_.v2 - metric_.nearer;
        const Lanes y1 = gap2(seen.dy, -1, -1) * metric_.v2 - metric_.nearer;
        const auto exceeds = [&](Lanes height, Lanes d2) {
            const Lanes above = most(height - seen.apex, Lanes{});
            return k2 * slack * d2 < above * above;
        };
        return exceeds(c.h00, x0 + y0) | exceeds(c.h10, x1 + y0) | exceeds(c.h01, x0 + y1) | exceeds(c.h11, x1 + y1);
    }

    __attribute__((noinline)) void search_inside(const Corners& c, const Seen& seen, LaneMask inside, Lanes& k2) {
        for (int l = 0; l < lane_count; ++l) {
            if (inside[l] == 0) continue;
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

    std::size_t at(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i);
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
    float patch_[patch][patch];                 // heights from `ring` texels before the tile on
    Lanes around_[2 * ring + 1][2 * ring + 1];  // around each texel of a group
    Lanes lane_x_[groups], lane_y_[groups];     // places of the lanes in the tile
    Lanes apex_[groups];                        // heights of the tile's texels
    Lanes slope2_[groups];                      // largest squared slope so far
    Lanes bound_[groups];                       // the same, less `slack`
    float lowest_ = 0;                          // of apex_
    float flattest_ = 0;                        // of bound_
};

template <class Rule>
void search_rows(const Rows& rows) {
    for (int row = rows.begin; row < rows.end; ++row) {
        Search<Rule> search(rows.field, rows.reach);
        for (int x = 0; x < rows.field.width(); x += tile) search.run(x, row * tile, rows.cones);
    }
}

}  // namespace relievo::cone_search::RELIEVO_MACHINE
