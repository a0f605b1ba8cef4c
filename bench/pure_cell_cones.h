// Cell cones as they were first drafted, and nothing else: of every bilinear cell its largest corner M and the ratio c of one straight
// cone, valid for an apex at height M over any point of the cell and toward all sides. What cell_cone_tracing is compared with; its
// map holds roofs instead (maps/cell_cone.h).
//
// Baked by branch and bound over the pyramid of maxima. Both numbers are held in 16 bits rounded to the safe side, c as c / (c + 1), so
// that no cone, however wide, is cut off.
#pragma once

#include "core/height_field.h"
#include "core/parallel_for.h"
#include "core/wrap.h"
#include "maps/max_pyramid.h"
#include "reference/cast.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace relievo::bench {

struct PureCellCones {
    int size = 0;
    std::vector<std::uint16_t> highest;  // M, times 65535
    std::vector<std::uint16_t> ratio;    // c / (c + 1), times 65535; c = UV per unit of height
};

// The search for the cone of one cell after another. Lengths in cells, c in cells per unit of height.
class PureConeSearch {
public:
    PureConeSearch(const HeightField& field, const MaxPyramid& pyramid) : field_(field), pyramid_(pyramid), size_(field.width()) {}

    double cone(int i, int j) {
        i_ = i;
        j_ = j;
        top_ = pyramid_.levels[0](i, j);
        best_ = std::numeric_limits<double>::infinity();
        // Its neighbours, and what limited the cell before, which is often what limits this one.
        for (int b = -1; b <= 1; ++b)
            for (int a = -1; a <= 1; ++a)
                if (a != 0 || b != 0) look_at(wrap_index(i + a, size_), wrap_index(j + b, size_));
        look_at(limit_.first, limit_.second);
        const int last = static_cast<int>(pyramid_.levels.size()) - 1;
        open_.clear();
        const ImageF& roots = pyramid_.levels[static_cast<std::size_t>(last)];
        for (int y = 0; y < roots.height; ++y)
            for (int x = 0; x < roots.width; ++x) put_down({x, y, last, 0});
        std::ranges::sort(open_, std::greater{}, &Node::square);
        while (!open_.empty()) {
            const Node node = open_.back();
            open_.pop_back();
            if (!may_limit(node)) continue;
            if (node.level == 0) {
                look_at(node.x, node.y);
                continue;
            }
            const ImageF& below = pyramid_.levels[static_cast<std::size_t>(node.level - 1)];
            const auto first = static_cast<std::ptrdiff_t>(open_.size());
            for (int y = 2 * node.y; y < std::min(2 * node.y + 2, below.height); ++y)
                for (int x = 2 * node.x; x < std::min(2 * node.x + 2, below.width); ++x) put_down({x, y, node.level - 1, 0});
            // The nearest is taken first, that is put down last.
            std::ranges::sort(open_.begin() + first, open_.end(), std::greater{}, &Node::square);
        }
        return best_;
    }

private:
    struct Node {
        int x;
        int y;
        int level;
        double square;  // of its distance from the cell, to its nearest copy
    };

    void put_down(Node node) {
        // A level is padded to whole nodes.
        if (node.x << node.level >= size_ || node.y << node.level >= size_) return;
        const double dx = gap(i_, node.x, node.level);
        const double dy = gap(j_, node.y, node.level);
        node.square = dx * dx + dy * dy;
        if (may_limit(node)) open_.push_back(node);
    }

    bool may_limit(const Node& node) const {
        const double over = pyramid_.levels[static_cast<std::size_t>(node.level)](node.x, node.y) - top_;
        return over > 0 && node.square < best_ * over * best_ * over;
    }

    // Cells between cell q and the node along one axis, whichever way round the period is shorter.
    double gap(int q, int node, int level) const {
        const int first = node << level;
        const int last = std::min((node + 1) << level, size_) - 1;
        if (first <= q && q <= last) return 0;
        return std::min(wrap_index(first - q, size_), wrap_index(q - last, size_)) - 1;
    }

    void look_at(int x, int y) {
        const auto nearest = [&](int d) { return 2 * d > size_ ? d - size_ : d; };
        const int dx = nearest(wrap_index(x - i_, size_));
        const int dy = nearest(wrap_index(y - j_, size_));
        // Half a period away there is a copy on either side.
        for (const int sx : {dx, 2 * dx == size_ ? -dx : dx})
            for (const int sy : {dy, 2 * dy == size_ ? -dy : dy}) {
                const double bound = ratio_to(sx, sy);
                if (bound < best_) {
                    best_ = bound;
                    limit_ = {x, y};
                }
            }
    }

    // No ratio of a distance from the cell to a height above M is smaller, over the cell that lies (dx, dy) farther: along an axis on which
    // they do not overlap, D the gap and E the gap across it, a point s into that cell is at least sqrt((D + s)^2 + E^2) away, and no higher
    // than between the larger ends of its near and its far column. Of two such bounds the larger holds.
    double ratio_to(int dx, int dy) const {
        if (dx == 0 && dy == 0) return std::numeric_limits<double>::infinity();
        const auto c = field_.cell(i_ + dx, j_ + dy);
        const double low_x = std::max(c[0], c[2]);
        const double high_x = std::max(c[1], c[3]);
        const double low_y = std::max(c[0], c[1]);
        const double high_y = std::max(c[2], c[3]);
        const double gap_x = std::max(std::abs(dx) - 1, 0);
        const double gap_y = std::max(std::abs(dy) - 1, 0);
        double bound = 0;
        if (dx != 0) bound = std::max(bound, along_axis(gap_x, gap_y, (dx > 0 ? low_x : high_x) - top_, (dx > 0 ? high_x : low_x) - top_));
        if (dy != 0) bound = std::max(bound, along_axis(gap_y, gap_x, (dy > 0 ? low_y : high_y) - top_, (dy > 0 ? high_y : low_y) - top_));
        if (std::abs(dx) == 1 && std::abs(dy) == 1) {
            // They share a corner, at most as high as M: (s, t) into the cell the surface is at most s + t - s t times its largest corner higher.
            const double over = std::max(low_x, high_x) - top_;
            if (over > 0) bound = std::max(bound, 1 / (std::sqrt(2.0) * over));
        }
        return bound;
    }

    // The least of sqrt(y^2 + E^2) / (a + b y), where the height is positive: at an end of [D, D + 1] or where y = b E^2 / a.
    static double along_axis(double D, double E, double near, double far) {
        double least = std::numeric_limits<double>::infinity();
        if (near > 0) least = std::min(least, std::sqrt(D * D + E * E) / near);
        if (far > 0) least = std::min(least, std::sqrt((D + 1) * (D + 1) + E * E) / far);
        const double b = far - near;
        const double a = near - b * D;
        if (a != 0) {
            const double y = b * E * E / a;
            if (y > D && y < D + 1 && a + b * y > 0) least = std::min(least, std::sqrt(y * y + E * E) / (a + b * y));
        }
        return least;
    }

    const HeightField& field_;
    const MaxPyramid& pyramid_;
    int size_;
    int i_ = 0;
    int j_ = 0;
    double top_ = 0;
    double best_ = 0;
    std::pair<int, int> limit_{0, 0};
    std::vector<Node> open_;
};

// pyramid: of the field, whose level 0 holds a cell's largest corner. The field is square.
inline PureCellCones pure_cell_cones(const HeightField& field, const MaxPyramid& pyramid) {
    const int size = field.width();
    PureCellCones cones;
    cones.size = size;
    cones.highest.resize(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    cones.ratio.resize(cones.highest.size());
    parallel_for(size, 4, 0, [&](int begin, int end) {
        PureConeSearch search(field, pyramid);
        for (int j = begin; j < end; ++j)
            for (int i = 0; i < size; ++i) {
                const auto k = static_cast<std::size_t>(j) * static_cast<std::size_t>(size) + static_cast<std::size_t>(i);
                const double c = search.cone(i, j) / size;
                cones.highest[k] = static_cast<std::uint16_t>(std::ceil(pyramid.levels[0](i, j) * 65535.0));
                cones.ratio[k] = static_cast<std::uint16_t>(std::isinf(c) ? 65535.0 : std::floor(c / (c + 1) * 65535.0));
            }
    });
    return cones;
}

struct PureHit {
    double height;  // the ray's end where nothing was met
    int fetches;    // one a cone, and one (a gather) a solved cell, as cell_cone_tracing's are counted
};

// From z = 1 down to 0, in double. The leap of the draft, (z - M) c / (c + R) from where the ray is, is a little short: the apex may be
// anywhere in the cell, so `from_wall` takes it from where the ray leaves it.
inline PureHit cast_pure(const HeightField& field, const PureCellCones& cones, const ReferenceRay& ray, bool from_wall) {
    const int size = cones.size;
    const double texels = size;
    const Vec2d pace = (ray.uv_per_height * -1.0) * Vec2d{texels, texels};  // cells per unit of descent
    const Vec2d start = (ray.uv + (1.0 - ray.zero_level) * ray.uv_per_height) * Vec2d{texels, texels} - Vec2d{0.5, 0.5};
    const double speed = length(ray.uv_per_height);
    int i = static_cast<int>(std::floor(start.x));
    int j = static_cast<int>(std::floor(start.y));
    double descent = 0;
    PureHit hit{0, 0};
    const auto wall = [](double s, double v, int cell) { return v == 0 ? 1e300 : ((v > 0 ? cell + 1 : cell) - s) / v; };
    while (descent < 1) {
        const auto k = static_cast<std::size_t>(wrap_index(j, size)) * static_cast<std::size_t>(size) + static_cast<std::size_t>(wrap_index(i, size));
        ++hit.fetches;
        const double top = cones.highest[k] / 65535.0;
        const double share = cones.ratio[k] / 65535.0;  // c / (c + 1)
        const double wall_x = wall(start.x, pace.x, i);
        const double wall_y = wall(start.y, pace.y, j);
        const double leave = std::max(descent, std::min(wall_x, wall_y));
        if (1 - std::min(leave, 1.0) <= top) {
            ++hit.fetches;
            const auto h = field.cell(i, j);
            const double x = std::clamp(start.x + pace.x * descent - i, 0.0, 1.0);
            const double y = std::clamp(start.y + pace.y * descent - j, 0.0, 1.0);
            const double bx = h[1] - h[0];
            const double by = h[2] - h[0];
            const double twist = h[3] - h[2] - bx;
            // Surface less ray, s farther down: gap + s (slope + s bend).
            const double gap = h[0] + bx * x + by * y + twist * x * y - (1 - descent);
            const double slope = bx * pace.x + by * pace.y + twist * (x * pace.y + y * pace.x) + 1;
            const double bend = twist * pace.x * pace.y;
            const double most = std::min(leave, 1.0) - descent;
            double at = gap >= 0 ? 0 : 2;
            const double discriminant = slope * slope - 4 * bend * gap;
            if (gap < 0 && discriminant >= 0) {
                const double q = -0.5 * (slope + std::copysign(std::sqrt(discriminant), slope));
                for (const double root : {bend != 0 ? q / bend : 2, q != 0 ? gap / q : 2})
                    if (root >= 0 && root <= most) at = std::min(at, root);
            }
            if (at <= 1) {
                hit.height = 1 - (descent + at);
                return hit;
            }
        }
        const double from = from_wall ? leave : descent;
        const double above = 1 - from - top;
        // c / (c + R), with c = share / (1 - share)
        const double leap = above > 0 ? from + above * share / (share + speed * (1 - share)) * (1 - 1e-9) : 0;
        if (leap > leave) {
            descent = leap;
            const int next_i = static_cast<int>(std::floor(start.x + pace.x * descent));
            const int next_j = static_cast<int>(std::floor(start.y + pace.y * descent));
            i = pace.x > 0 ? std::max(i + (wall_x <= descent), next_i) : std::min(i - (wall_x <= descent), next_i);
            j = pace.y > 0 ? std::max(j + (wall_y <= descent), next_j) : std::min(j - (wall_y <= descent), next_j);
        } else {
            descent = leave;
            if (wall_x <= leave) i += pace.x > 0 ? 1 : -1;
            if (wall_y <= leave) j += pace.y > 0 ? 1 : -1;
        }
    }
    return hit;
}

}  // namespace relievo::bench
