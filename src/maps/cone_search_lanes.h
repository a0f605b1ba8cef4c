// The search that the cones of the declared surface share: for every texel, over all bilinear cells of the repeated field, the least
// squared ratio that a rule finds. Branch and bound over a pyramid of cell maxima; all texels of a tile search together, so that
// the walk is paid once a tile and the tests run in SIMD lanes, nearest nodes first, so that the bound is small when far ones are met.
//
// Included once for every kind of machine (core/each_machine.h), in its namespace: no include guard.

namespace relievo::cone_search::RELIEVO_MACHINE {

// Under GCC's and Clang's vector extension, as wide as a register of the machine: wider ones would be taken apart lane by lane.
using Lanes = float __attribute__((vector_size(4 * RELIEVO_LANES)));
using LaneMask = std::int32_t __attribute__((vector_size(4 * RELIEVO_LANES)));
constexpr int lane_count = RELIEVO_LANES;

// A cell's first corner as several texels see it: places in texels from them, and their own heights.
struct Seen {
    Lanes dx, dy;
    Lanes apex;
};

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
inline Lanes least(Lanes a, Lanes b) { return a < b ? a : b; }
inline Lanes most(Lanes a, Lanes b) { return a > b ? a : b; }
inline Lanes magnitude(Lanes a) { return a < 0.0f ? -a : a; }

// Where the height a + b v over the squared distance e2 + (y + v)^2 s2 is steepest from the apex, v in [low, high]: the quotient
// (a + b v) / distance rises, then falls, wherever it is positive; its derivative vanishes at  y + v = b e2 / (s2 (a - b y)).
inline Lanes steepest(Lanes a, Lanes b, Lanes e2, Lanes y, float s2, Lanes low, Lanes high) {
    const Lanes at_foot = (a - b * y) * s2;
    const Lanes v = at_foot > 0.0f ? b * e2 / at_foot - y : high;
    return most(low, least(high, v));
}

// The squared ratio (distance / rise)^2 there, from the nearer end, so that little is lost to cancellation.
inline Lanes squared_ratio(Lanes a, Lanes a1, Lanes e2, Lanes y, float s2, Lanes v) {
    const Lanes b = a1 - a;
    const Lanes rise = v < 0.5f ? a + b * v : a1 - b * (1.0f - v);
    const Lanes along = y + v;
    return rise > 0.0f ? (e2 + along * along * s2) / (rise * rise) : no_limit + Lanes{};
}

// Rule: what a cell does to a cone.
//   static constexpr int channels, static float reach(...)          as in cone_search.h
//   static LaneMask limit(const Corners&, const Seen&, const Metric&, LaneMask within, Lanes& q)
//       lowers the squared ratios q by what the cell's edges allow; the lanes in which a point inside the cell may be lower still
//   static double inside(const Cell&, const Metric&, double least)  the squared ratio of that point, or no_limit if not below `least`
template <class Rule>
class Search {
    static constexpr int groups = tile_w * tile_h / lane_count;

public:
    using Levels = std::vector<ImageF>;

    Search(const HeightField& field, const Levels& levels)
        : texels_(field.texels), levels_(levels), width_(field.width()), height_(field.height()),
          metric_{width_, height_, 1.0f / (static_cast<float>(width_) * static_cast<float>(width_)),
                  1.0f / (static_cast<float>(height_) * static_cast<float>(height_))} {
        for (int g = 0; g < groups; ++g)
            for (int l = 0; l < lane_count; ++l) {
                lane_x_[g][l] = static_cast<float>(column(g, l));
                lane_y_[g][l] = static_cast<float>(row(g, l));
            }
    }

    // Finds the cones of the texels of the tile whose first texel is (x0, y0), and writes height and ratio.
    void run(int x0, int y0, ImageF& cones) {
        x0_ = x0;
        y0_ = y0;
        lowest_ = 2;
        for (int g = 0; g < groups; ++g)
            for (int l = 0; l < lane_count; ++l) {
                const int x = x0 + column(g, l);
                const int y = y0 + row(g, l);
                const bool exists = x < width_ && y < height_;
                // Lanes beyond the map stand above everything, so nothing ever limits them.
                const float apex = exists ? texels_(x, y) : 2.0f;
                apex_[g][l] = apex;
                q_[g][l] = 1.0f;
                bound_[g][l] = exists ? slack : 0.0f;
                lowest_ = std::min(lowest_, apex);
            }
        widest_ = slack;
        // What limited the tile before mostly limits this one, and else it is beside it; having that first closes most nodes.
        for (int k = 0; k < kept_; ++k) {
            const Place seed = seeds_[k];
            cell(seed.i, seed.j, wrap_index(seed.i, width_), wrap_index(seed.j, height_));
        }
        narrowed_ = 0;
        for (int j = y0 - 1; j < y0 + tile_h; ++j)
            for (int i = x0 - 1; i < x0 + tile_w; ++i) cell(i, j, wrap_index(i, width_), wrap_index(j, height_));
        tighten();
        descend();
        // Those that came last narrowed what others had narrowed before. Seeds of the first half come before them again.
        kept_ = static_cast<int>(std::min<std::size_t>(narrowed_, seed_count));
        for (int k = 0; k < kept_; ++k) seeds_[k] = recent_[(narrowed_ - 1 - static_cast<std::size_t>(k)) % seed_count];
        for (int g = 0; g < groups; ++g)
            for (int l = 0; l < lane_count; ++l) {
                const int x = x0 + column(g, l);
                const int y = y0 + row(g, l);
                if (x >= width_ || y >= height_) continue;
                cones(x, y, 0) = apex_[g][l];
                const float q = q_[g][l];
                cones(x, y, 1) = q < 1.0f ? std::sqrt(q) * rounding_down : 1.0f;
            }
    }

private:
    static constexpr int column(int g, int l) { return (g * lane_count + l) % tile_w; }
    static constexpr int row(int g, int l) { return (g * lane_count + l) / tile_w; }

    struct Node {
        int level, i, j;         // in the pyramid
        int origin_x, origin_y;  // of the repeat it is taken from, texels
    };

    void descend() {
        const int top = static_cast<int>(levels_.size()) - 1;
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
                block(n);
                continue;
            }
            // Nearest child last, so that it is taken first.
            const ImageF& below = levels_[static_cast<std::size_t>(n.level - 1)];
            const int near_i = x0_ >= n.origin_x + ((2 * n.i + 1) << (n.level - 1)) ? 1 : 0;
            const int near_j = y0_ >= n.origin_y + ((2 * n.j + 1) << (n.level - 1)) ? 1 : 0;
            for (int k = 3; k >= 0; --k) {
                const int i = 2 * n.i + (near_i ^ (k & 1));
                const int j = 2 * n.j + (near_j ^ (k >> 1));
                if (i < below.width && j < below.height) open_.push_back({n.level - 1, i, j, n.origin_x, n.origin_y});
            }
        }
    }

    // Largest reach of a node whose cells span texels [low, high], for the quadrants in which the tile sees it.
    float reach_of(const float* reach, int low_x, int high_x, int low_y, int high_y) const {
        if constexpr (Rule::channels == 1) {
            return reach[0];
        } else {
            const bool right = high_x > x0_;
            const bool left = low_x < x0_ + tile_w - 1;
            const bool up = high_y > y0_;
            const bool down = low_y < y0_ + tile_h - 1;
            float all = -1;
            if (right && up) all = std::max(all, reach[0]);
            if (left && up) all = std::max(all, reach[1]);
            if (right && down) all = std::max(all, reach[2]);
            if (left && down) all = std::max(all, reach[3]);
            return all;
        }
    }

    static float gap(int first, int texels, int low, int high) {
        return static_cast<float>(std::max(0, std::max(low - (first + texels - 1), first - high)));
    }

    // Whether a region of texel coordinates [low, high] with nothing above `top` may limit any texel of the tile, as far as the lowest
    // of them and the widest cone tell.
    bool may_limit_any(float top, int low_x, int high_x, int low_y, int high_y) const {
        if (top <= lowest_) return false;
        const float gx = gap(x0_, tile_w, low_x, high_x);
        const float gy = gap(y0_, tile_h, low_y, high_y);
        const float rise = top - lowest_;
        return gx * gx * metric_.u2 + gy * gy * metric_.v2 < widest_ * rise * rise;
    }

    bool may_limit(float top, int low_x, int high_x, int low_y, int high_y) const {
        if (!may_limit_any(top, low_x, high_x, low_y, high_y)) return false;
        LaneMask within{};
        for (int g = 0; g < groups; ++g) {
            const Lanes dx = static_cast<float>(low_x - x0_) - lane_x_[g];
            const Lanes dy = static_cast<float>(low_y - y0_) - lane_y_[g];
            const Lanes away_x = most(most(dx, static_cast<float>(low_x - high_x) - dx), Lanes{});
            const Lanes away_y = most(most(dy, static_cast<float>(low_y - high_y) - dy), Lanes{});
            const Lanes above = top - apex_[g];
            within |= (away_x * away_x * metric_.u2 + away_y * away_y * metric_.v2 < bound_[g] * above * above) & (above > 0.0f);
        }
        return any(within);
    }

    bool may_limit(const Node& n) const {
        const int low_x = n.origin_x + (n.i << n.level);
        const int low_y = n.origin_y + (n.j << n.level);
        const int high_x = n.origin_x + std::min(width_, (n.i + 1) << n.level);
        const int high_y = n.origin_y + std::min(height_, (n.j + 1) << n.level);
        const float top = reach_of(levels_[static_cast<std::size_t>(n.level)].at(n.i, n.j), low_x, high_x, low_y, high_y);
        return may_limit(top, low_x, high_x, low_y, high_y);
    }

    void block(const Node& n) {
        const int end_x = std::min(width_, (n.i + 1) << n.level);
        const int end_y = std::min(height_, (n.j + 1) << n.level);
        bool changed = false;
        for (int j = n.j << n.level; j < end_y; ++j)
            for (int i = n.i << n.level; i < end_x; ++i) changed |= cell(n.origin_x + i, n.origin_y + j, i, j);
        if (changed) tighten();
    }

    // The tile's texels against the cell whose first corner is texel (i, j), unwrapped; (wi, wj) is the same within the period.
    bool cell(int i, int j, int wi, int wj) {
        const float top = reach_of(levels_[0].at(wi, wj), i, i + 1, j, j + 1);
        if (!may_limit_any(top, i, i + 1, j, j + 1)) return false;
        const int wi1 = wi + 1 == width_ ? 0 : wi + 1;
        const int wj1 = wj + 1 == height_ ? 0 : wj + 1;
        const Corners corners{texels_(wi, wj), texels_(wi1, wj), texels_(wi, wj1), texels_(wi1, wj1)};
        bool changed = false;
        for (int g = 0; g < groups; ++g) {
            const Lanes dx = static_cast<float>(i - x0_) - lane_x_[g];
            const Lanes dy = static_cast<float>(j - y0_) - lane_y_[g];
            const Lanes x = most(dx, -1.0f - dx);
            const Lanes y = most(dy, -1.0f - dy);
            const Lanes above = top - apex_[g];
            const Lanes d2 = x * x * metric_.u2 + y * y * metric_.v2;
            const LaneMask within = (d2 < bound_[g] * above * above) & (above > 0.0f);
            if (!any(within)) continue;
            const Lanes before = q_[g];
            const LaneMask inside = Rule::limit(corners, {dx, dy, apex_[g]}, metric_, within, q_[g]) & (d2 < q_[g] * slack * above * above);
            if (any(inside)) search_inside(corners, g, dx, dy, inside);
            bound_[g] = bound_[g] > 0.0f ? q_[g] * slack : bound_[g];
            changed |= any(q_[g] < before);
        }
        if (changed) recent_[narrowed_++ % seed_count] = {i, j};
        return changed;
    }

    __attribute__((noinline)) void search_inside(const Corners& c, int g, Lanes dx, Lanes dy, LaneMask inside) {
        for (int l = 0; l < lane_count; ++l) {
            if (inside[l] == 0) continue;
            const double apex = apex_[g][l];
            const bool right = dx[l] >= 0;
            const bool up = dy[l] >= 0;
            const double low_near = right ? c.h00 : c.h10, low_far = right ? c.h10 : c.h00;
            const double high_near = right ? c.h01 : c.h11, high_far = right ? c.h11 : c.h01;
            const Cell turned{(up ? low_near : high_near) - apex, (up ? low_far : high_far) - apex, (up ? high_near : low_near) - apex,
                              (up ? high_far : low_far) - apex,   right ? dx[l] : -1 - dx[l],       up ? dy[l] : -1 - dy[l]};
            q_[g][l] = std::min(q_[g][l], static_cast<float>(Rule::inside(turned, metric_, q_[g][l])));
        }
    }

    void tighten() {
        Lanes widest{};
        for (int g = 0; g < groups; ++g) widest = most(widest, bound_[g]);
        widest_ = 0;
        for (int l = 0; l < lane_count; ++l) widest_ = std::max(widest_, widest[l]);
    }

    const ImageF& texels_;
    const Levels& levels_;
    int width_, height_;
    Metric metric_;
    std::vector<Node> open_;

    // Cells that narrowed a cone of this tile, the latest ones, and what is taken over from the tile before. A row of tiles starts with
    // none, so that the result does not depend on how rows are shared out.
    struct Place {
        int i, j;
    };
    static constexpr std::size_t seed_count = 16;
    Place recent_[seed_count], seeds_[seed_count];
    std::size_t narrowed_ = 0;
    int kept_ = 0;

    int x0_ = 0, y0_ = 0;
    Lanes lane_x_[groups], lane_y_[groups];  // places of the lanes in the tile
    Lanes apex_[groups];     // heights of the tile's texels
    Lanes q_[groups];        // least squared ratio so far
    Lanes bound_[groups];    // the same, widened by `slack`; 0 in lanes beyond the map
    float lowest_ = 0;       // of apex_
    float widest_ = 0;       // of bound_
};

template <class Rule>
void search_rows(const Rows& rows) {
    for (int row = rows.begin; row < rows.end; ++row) {
        Search<Rule> search(rows.field, rows.levels);
        for (int x = 0; x < rows.field.width(); x += tile_w) search.run(x, row * tile_h, rows.cones);
    }
}

}  // namespace relievo::cone_search::RELIEVO_MACHINE
