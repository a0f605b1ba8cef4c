#include "maps/cone_verifier.h"

#include "core/error.h"
#include "core/parallel_for.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace relievo {

namespace {

constexpr double margin = 0x1p-44;  // 64 roundings of 2^-53 of quantities below 8
constexpr int deepest_part = 40;
// A cone that meets the surface along a curve could be taken apart for ever; the hardest of ours took 2^11.
constexpr std::uint64_t most_checks = 1u << 18;

struct Range {
    double low, high;
    void include(const Range& r) {
        low = std::min(low, r.low);
        high = std::max(high, r.high);
    }
};

// What is known of 2^k x 2^k cells: their highest point, and between which limits the surface's derivatives lie, per texel.
struct Region {
    double highest;
    Range hx, hy;
};

class Pyramid {
public:
    explicit Pyramid(const HeightField& field) : width_(field.width()), height_(field.height()) {
        std::vector<Region> cells;
        cells.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
        for (int j = 0; j < height_; ++j)
            for (int i = 0; i < width_; ++i) {
                const auto c = field.cell(i, j);
                const double bottom = static_cast<double>(c[1]) - c[0];
                const double top = static_cast<double>(c[3]) - c[2];
                const double left = static_cast<double>(c[2]) - c[0];
                const double right = static_cast<double>(c[3]) - c[1];
                cells.push_back({*std::ranges::max_element(c), {std::min(bottom, top), std::max(bottom, top)}, {std::min(left, right), std::max(left, right)}});
            }
        levels_.push_back(std::move(cells));
        while (columns(top()) > 1 || rows(top()) > 1) {
            const int k = top() + 1;
            std::vector<Region> level;
            for (int j = 0; j < rows(k); ++j)
                for (int i = 0; i < columns(k); ++i) {
                    Region all = at(k - 1, 2 * i, 2 * j);
                    for (int child = 1; child < 4; ++child) {
                        const int ci = std::min(2 * i + (child & 1), columns(k - 1) - 1);
                        const int cj = std::min(2 * j + (child >> 1), rows(k - 1) - 1);
                        const Region& r = at(k - 1, ci, cj);
                        all.highest = std::max(all.highest, r.highest);
                        all.hx.include(r.hx);
                        all.hy.include(r.hy);
                    }
                    level.push_back(all);
                }
            levels_.push_back(std::move(level));
        }
    }
    int top() const { return static_cast<int>(levels_.size()) - 1; }
    int columns(int k) const { return (width_ + (1 << k) - 1) >> k; }
    int rows(int k) const { return (height_ + (1 << k) - 1) >> k; }
    const Region& at(int k, int i, int j) const { return levels_[static_cast<std::size_t>(k)][static_cast<std::size_t>(j) * static_cast<std::size_t>(columns(k)) + static_cast<std::size_t>(i)]; }

private:
    int width_, height_;
    std::vector<std::vector<Region>> levels_;
};

enum class Verdict { kept, broken, open };

class Prover {
public:
    Prover(const HeightField& field, const Pyramid& pyramid, ConePromise promise)
        : field_(field), pyramid_(pyramid), relaxed_(promise == ConePromise::relaxed), w_(field.width()), h_(field.height()) {}

    Verdict decide(const ConeApex& cone) {
        cone_ = cone;
        last_check_ = checks + most_checks;
        Verdict verdict = Verdict::kept;
        open_.clear();
        for (int b = -1; b <= 1; ++b)
            for (int a = -1; a <= 1; ++a)
                if (a != 0 || b != 0) open_.push_back({pyramid_.top(), 0, 0, a * field_.width(), b * field_.height()});
        open_.push_back({pyramid_.top(), 0, 0, 0, 0});
        while (!open_.empty()) {
            const Node n = open_.back();
            open_.pop_back();
            const int end_i = std::min(field_.width(), (n.i + 1) << n.level);
            const int end_j = std::min(field_.height(), (n.j + 1) << n.level);
            const Range x{n.origin_x + (n.i << n.level) - cone_.x, n.origin_x + end_i - cone_.x};
            const Range y{n.origin_y + (n.j << n.level) - cone_.y, n.origin_y + end_j - cone_.y};
            if (empty(pyramid_.at(n.level, n.i, n.j), x, y)) {
                pairs += static_cast<std::uint64_t>(end_i - (n.i << n.level)) * static_cast<std::uint64_t>(end_j - (n.j << n.level));
                continue;
            }
            if (n.level > 0) {
                // Nearest child last, so that it is taken first: a broken cone is mostly broken near its apex.
                const int near_i = x.low + x.high < 0 ? 1 : 0;
                const int near_j = y.low + y.high < 0 ? 1 : 0;
                for (int k = 3; k >= 0; --k) {
                    const int i = 2 * n.i + (near_i ^ (k & 1));
                    const int j = 2 * n.j + (near_j ^ (k >> 1));
                    if (i < pyramid_.columns(n.level - 1) && j < pyramid_.rows(n.level - 1)) open_.push_back({n.level - 1, i, j, n.origin_x, n.origin_y});
                }
                continue;
            }
            load(n.i, n.j, x.low, y.low);
            const Verdict v = whole_cell();
            if (v == Verdict::broken) return v;
            if (v == Verdict::open) verdict = v;
            else ++pairs;
        }
        return verdict;
    }

    std::uint64_t checks = 0;
    std::uint64_t pairs = 0;
    double deepest = 0;

private:
    struct Node {
        int level, i, j;
        int origin_x, origin_y;  // of its repeat
    };

    double distance(double x, double y) const { return std::hypot(x / w_, y / h_); }

    // Whether a region at [x] x [y] from the apex holds no point that the cone must be free of.
    bool empty(const Region& region, const Range& x, const Range& y) {
        ++checks;
        const double rise = region.highest - cone_.height;
        if (rise <= 0) return true;
        const double gap_x = std::max({0.0, x.low, -x.high}) / w_;
        const double gap_y = std::max({0.0, y.low, -y.high}) / h_;
        if (std::sqrt(gap_x * gap_x + gap_y * gap_y) - cone_.ratio * rise >= margin) return true;
        return relaxed_ && least_product(x, region.hx) + least_product(y, region.hy) >= 0;
    }

    static double least_product(const Range& a, const Range& b) { return std::min(std::min(a.low * b.low, a.low * b.high), std::min(a.high * b.low, a.high * b.high)); }

    void load(int i, int j, double x, double y) {
        const auto c = field_.cell(i, j);
        h00_ = c[0];
        bx_ = static_cast<double>(c[1]) - c[0];
        by_ = static_cast<double>(c[2]) - c[0];
        twist_ = static_cast<double>(c[3]) - c[1] - (static_cast<double>(c[2]) - c[0]);
        x_ = x;
        y_ = y;
    }

    Verdict whole_cell() {
        // The apex in the cell or on its rim: apart at the apex, each quarter with the apex at its corner.
        if (x_ > 0 || x_ < -1 || y_ > 0 || y_ < -1) return part(0, 1, 0, 1, 0);
        Verdict verdict = Verdict::kept;
        for (const int sx : {-1, 1})
            for (const int sy : {-1, 1}) {
                const double wide = sx > 0 ? 1 + x_ : -x_;
                const double high = sy > 0 ? 1 + y_ : -y_;
                if (wide <= 0 || high <= 0) continue;
                const Verdict v = quarter(sx, sy, wide, high, 0);
                if (v == Verdict::broken) return v;
                if (v == Verdict::open) verdict = v;
            }
        return verdict;
    }

    // The part of the cell that reaches from the apex by (wide, high) texels in the directions (sx, sy).
    Verdict quarter(int sx, int sy, double wide, double high, int depth) {
        ++checks;
        const double u = -x_;
        const double v = -y_;
        const double above = rise(u, v);  // of the surface over the apex
        if (above > margin) {
            deepest = std::max(deepest, 1.0);
            return Verdict::broken;
        }
        const double gx = sx * (bx_ + twist_ * v) * w_;
        const double gy = sy * (by_ + twist_ * u) * h_;
        const double twist = sx * sy * twist_ * w_ * h_;
        const double x = wide / w_;
        const double y = high / h_;
        const double reach = std::hypot(x, y);
        // At distance r the surface is at most `above` + (A + B X Y / r) r over the apex, A the gradient's rising components; X Y / r is
        // largest at the far corner, and so is the rest if the cone is narrower than that near the apex.
        const double steepest = std::hypot(std::max(gx, 0.0), std::max(gy, 0.0));
        const double excess = cone_.ratio * (steepest + std::max(twist, 0.0) * x * y / reach) - 1;
        if (excess * reach + cone_.ratio * std::min(above, 0.0) <= -margin * reach) return Verdict::kept;
        // Where the surface is twisted upward its slope from the apex grows along every ray, so that the far sides decide.
        if (twist > 0 && outside(x, y, gx * x, gy + twist * x) && outside(y, x, gy * y, gx + twist * y)) return Verdict::kept;
        if (relaxed_) {
            // Falling, gx X + gy Y + 2 twist X Y < 0, and above the apex, gx X + gy Y + twist X Y > 0: only where twist < 0, and by less
            // than |twist| X Y.
            if (twist >= 0 || -twist * cone_.ratio * x * y <= reach * (1 - margin)) return Verdict::kept;
        } else if (above > -margin && cone_.ratio * steepest > 1 + 0x1p-30) {
            deepest = std::max(deepest, 1 - 1 / (cone_.ratio * steepest));
            return Verdict::broken;
        }
        if (depth == deepest_part || checks > last_check_) return Verdict::open;
        const double wide2 = wide / 2;
        const double high2 = high / 2;
        Verdict verdict = quarter(sx, sy, wide2, high2, depth + 1);
        for (const auto& [a, b] : {std::pair{1, 0}, {0, 1}, {1, 1}}) {
            if (verdict == Verdict::broken) return verdict;
            const double u0 = u + sx * a * wide2;
            const double u1 = u + sx * (a + 1) * wide2;
            const double v0 = v + sy * b * high2;
            const double v1 = v + sy * (b + 1) * high2;
            const Verdict p = part(std::min(u0, u1), std::max(u0, u1), std::min(v0, v1), std::max(v0, v1), depth + 1);
            if (p != Verdict::kept) verdict = p;
        }
        return verdict;
    }

    // Whether a side at distance `across` from the apex, from its foot to `along`, and of height a + b t over the apex, lies outside the
    // cone: |(across, t)| - c b t is convex, and least, across sqrt(1 - (c b)^2), where t = across c b / sqrt(1 - (c b)^2), or at the
    // nearer end.
    bool outside(double across, double along, double a, double b) const {
        const double cb = cone_.ratio * b;
        const double root = cb < 1 ? std::sqrt((1 - cb) * (1 + std::max(cb, 0.0))) : 0.0;
        double least = across * root;
        if (cb <= 0) least = across;
        else if (across * cb >= along * root) least = std::hypot(across, along) - cb * along;
        return least - cone_.ratio * a >= margin;
    }

    // The part [u0, u1] x [v0, v1] of the cell, not containing the apex.
    Verdict part(double u0, double u1, double v0, double v1, int depth) {
        ++checks;
        const double u = 0.5 * (u0 + u1);
        const double v = 0.5 * (v0 + v1);
        const double a = 0.5 * (u1 - u0);
        const double b = 0.5 * (v1 - v0);
        const double x = x_ + u;
        const double y = y_ + v;
        const double hx = bx_ + twist_ * v;
        const double hy = by_ + twist_ * u;
        const double r = distance(x, y);
        const double s = r - cone_.ratio * rise(u, v);
        const double sx = x / (w_ * w_ * r) - cone_.ratio * hx;
        const double sy = y / (h_ * h_ * r) - cone_.ratio * hy;
        const double twisted = cone_.ratio * std::abs(twist_) * a * b;
        if (s - std::abs(sx) * a - std::abs(sy) * b - twisted >= margin) return Verdict::kept;
        if (relaxed_) {
            // The radial derivative times the distance, bilinear as well.
            const double g = x * hx + y * hy;
            const double g_x = hx + y * twist_;
            const double g_y = hy + x * twist_;
            const double g_low = g - 2 * std::abs(twist_) * a * b;
            if (g_low - std::abs(g_x) * a - std::abs(g_y) * b >= 0 || falls_nowhere(u0, u1, v0, v1)) return Verdict::kept;
            for (const double multiple : {g_x != 0 ? -sx / g_x : 0.0, g_y != 0 ? -sy / g_y : 0.0}) {
                if (!(multiple > 0)) continue;
                const double low = s - std::abs(sx + multiple * g_x) * a - std::abs(sy + multiple * g_y) * b - twisted + multiple * g_low;
                const double rounding = multiple * (std::abs(g) + std::abs(g_x) + std::abs(g_y)) * 0x1p-48;
                if (low >= margin + rounding) return Verdict::kept;
            }
        }
        // Where s is least as far as the gradient tells: most cones are broken on the rim of a cell, and only just.
        const bool right = sx < 0;
        const bool top = sy < 0;
        if (breaks(u, v) || breaks(right ? u1 : u0, top ? v1 : v0)) return Verdict::broken;
        if (depth == deepest_part || checks > last_check_) return Verdict::open;
        Verdict verdict = Verdict::kept;
        const int likely = (right ? 1 : 0) + (top ? 2 : 0);
        for (int turn = 0; turn < 4; ++turn) {
            const int k = turn ^ likely;
            const Verdict p = part((k & 1) != 0 ? u : u0, (k & 1) != 0 ? u1 : u, (k & 2) != 0 ? v : v0, (k & 2) != 0 ? v1 : v, depth + 1);
            if (p == Verdict::broken) return p;
            if (p == Verdict::open) verdict = p;
        }
        return verdict;
    }

    // Bilinear, so that its least value is at a corner.
    bool falls_nowhere(double u0, double u1, double v0, double v1) const {
        for (const double u : {u0, u1})
            for (const double v : {v0, v1})
                if ((x_ + u) * (bx_ + twist_ * v) + (y_ + v) * (by_ + twist_ * u) < 0) return false;
        return true;
    }

    double rise(double u, double v) const { return h00_ + bx_ * u + by_ * v + twist_ * u * v - cone_.height; }

    // Whether the surface at (u, v) of the cell is in the cone, beyond what rounding explains.
    bool breaks(double u, double v) {
        const double x = x_ + u;
        const double y = y_ + v;
        const double reach = cone_.ratio * rise(u, v);
        const double r = distance(x, y);
        if (r - reach >= -margin) return false;
        if (relaxed_) {
            const double along_x = x * (bx_ + twist_ * v);
            const double along_y = y * (by_ + twist_ * u);
            if (along_x + along_y >= -(std::abs(along_x) + std::abs(along_y)) * 0x1p-48) return false;
        }
        deepest = std::max(deepest, 1 - r / reach);
        return true;
    }

    const HeightField& field_;
    const Pyramid& pyramid_;
    bool relaxed_;
    double w_, h_;
    std::vector<Node> open_;
    ConeApex cone_{};
    std::uint64_t last_check_ = 0;
    // The cell: height h00 + bx u + by v + twist u v at (u, v) of it, whose corner is (x, y) texels from the apex.
    double h00_ = 0, bx_ = 0, by_ = 0, twist_ = 0, x_ = 0, y_ = 0;
};

}  // namespace

Verification verify_cones(const HeightField& field, std::span<const ConeApex> cones, ConePromise promise, int threads, const Progress& progress) {
    for (const ConeApex& c : cones)
        if (!(c.ratio >= 0 && c.ratio <= 1 && c.height >= 0 && c.height <= 1))
            throw Error("verify", "a cone map", "ratio " + std::to_string(c.ratio) + " over height " + std::to_string(c.height) + " at texel " + std::to_string(c.x) + ", " + std::to_string(c.y) + " is out of range",
                        "ratios and heights lie in [0,1]");
    const Pyramid pyramid(field);
    const int count = static_cast<int>(cones.size());
    constexpr int grain = 1024;
    std::vector<Verification> blocks(static_cast<std::size_t>((count + grain - 1) / grain));
    parallel_for(count, grain, threads, [&](int begin, int end) {
        Prover prover(field, pyramid, promise);
        Verification& v = blocks[static_cast<std::size_t>(begin / grain)];
        for (int k = begin; k < end; ++k) {
            const ConeApex& cone = cones[static_cast<std::size_t>(k)];
            const Verdict verdict = prover.decide(cone);
            if (verdict == Verdict::broken && v.violated++ == 0) v.first = cone;
            v.undecided += verdict == Verdict::open;
            ++v.cones;
        }
        v.pairs = prover.pairs;
        v.checks = prover.checks;
        v.deepest = prover.deepest;
    }, progress, "verifying cones");
    Verification all;
    for (const Verification& v : blocks) {
        if (all.violated == 0 && v.violated > 0) all.first = v.first;
        all.cones += v.cones;
        all.pairs += v.pairs;
        all.checks += v.checks;
        all.violated += v.violated;
        all.undecided += v.undecided;
        all.deepest = std::max(all.deepest, v.deepest);
    }
    return all;
}

std::vector<ConeApex> texel_cones(const ImageF& map) {
    std::vector<ConeApex> cones;
    cones.reserve(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
    for (int j = 0; j < map.height; ++j)
        for (int i = 0; i < map.width; ++i) cones.push_back({static_cast<double>(i), static_cast<double>(j), map(i, j, 0), map(i, j, 1)});
    return cones;
}

std::vector<ConeApex> scattered_cones(const HeightField& field, const ImageF& map, std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto within = [&] { return (random() + 0.5) * 0x1p-32 - 0.5; };
    std::vector<ConeApex> cones = texel_cones(map);
    for (ConeApex& c : cones) {
        c.x += within();
        c.y += within();
        c.height = std::clamp(field.sample({(c.x + 0.5) / field.width(), (c.y + 0.5) / field.height()}), 0.0, 1.0);
    }
    return cones;
}

}  // namespace relievo
