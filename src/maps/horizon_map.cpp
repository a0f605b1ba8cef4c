#include "maps/horizon_map.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <vector>

namespace relievo {

namespace {

// A piece of a step inside one cell. The surface along it is a quadratic: linear from end to end, and a bulge of s (1 - s) times
// the cell's twist h00 - h10 - h01 + h11 times `twisted`.
struct Piece {
    double begin, length;  // as shares of the step
    Vec2i cell;            // from the texel where the step begins
    Vec2d from, to;        // in the cell
    double twisted;
};

// A direction and how one of its steps runs over the cells; a primitive step: (4,4) and (4,2) go through (1,1) and (2,1).
struct Line {
    Vec2i step;
    double length_uv;
    std::vector<Piece> pieces;
};

Line line_of(int direction, int width, int height) {
    Vec2i step = horizon_step(direction);
    const int shared = std::gcd(step.x, step.y);
    step = {step.x / shared, step.y / shared};
    Line line{.step = step, .length_uv = std::hypot(static_cast<double>(step.x) / width, static_cast<double>(step.y) / height), .pieces = {}};
    std::vector<double> walls{0, 1};
    for (int i = 1; i < std::abs(step.x); ++i) walls.push_back(static_cast<double>(i) / std::abs(step.x));
    for (int j = 1; j < std::abs(step.y); ++j) walls.push_back(static_cast<double>(j) / std::abs(step.y));
    std::ranges::sort(walls);
    walls.erase(std::unique(walls.begin(), walls.end()), walls.end());
    for (std::size_t k = 1; k < walls.size(); ++k) {
        const Vec2d a{walls[k - 1] * step.x, walls[k - 1] * step.y};
        const Vec2d b{walls[k] * step.x, walls[k] * step.y};
        // Along a wall either cell will do: they share it.
        const Vec2i cell{static_cast<int>(std::floor((a.x + b.x) / 2)), static_cast<int>(std::floor((a.y + b.y) / 2))};
        line.pieces.push_back({walls[k - 1], walls[k] - walls[k - 1], cell, {a.x - cell.x, a.y - cell.y}, {b.x - cell.x, b.y - cell.y},
                               -(b.x - a.x) * (b.y - a.y)});
    }
    return line;
}

double height_in(const std::array<float, 4>& c, Vec2d p) {
    return (c[0] * (1 - p.x) + c[1] * p.x) * (1 - p.y) + (c[2] * (1 - p.x) + c[3] * p.x) * p.y;
}

// A point that can be a horizon; the texel it is, if it is one.
struct Point {
    double at;  // along the ring, in steps
    double height;
    float* code = nullptr;  // where a texel's answer goes
};

double slope(const Point& from, const Point& to) { return (to.height - from.height) / (to.at - from.at); }

// The profile of a ring as points none of which is below the surface's upper hull. A concave arc stands in for itself by points on
// its tangents: cut into four, they miss it by a 16th of what the tangents at its ends alone would. A convex one is below its chord.
void gather(const HeightField& field, const Line& line, Vec2i start, int direction, ImageF& map, std::vector<Point>& points) {
    constexpr double flat = 1.0 / 4096;  // bulges below this are not worth cutting: a 16000th of the height is missed
    points.clear();
    Vec2i p = start;
    double at = 0;
    do {
        for (const Piece& piece : line.pieces) {
            const auto corners = field.cell(p.x + piece.cell.x, p.y + piece.cell.y);
            const double h0 = piece.begin == 0 ? field.texels(p.x, p.y) : height_in(corners, piece.from);
            points.push_back({at + piece.begin, h0, piece.begin == 0 ? &map(p.x, p.y, direction) : nullptr});
            const double bulge = piece.twisted * ((static_cast<double>(corners[0]) - corners[1]) - (static_cast<double>(corners[2]) - corners[3]));
            if (!(bulge > 0)) continue;
            const double rise = height_in(corners, piece.to) - h0;
            const int arcs = bulge > flat ? 4 : 1;
            for (int k = 0; k < arcs; ++k) {
                // Tangents at both ends of an arc of length 1 / arcs meet in its middle, bulge / (2 arcs)^2 above it.
                const double s = (k + 0.5) / arcs;
                points.push_back({at + piece.begin + piece.length * s, h0 + rise * s + bulge * (s * (1 - s) + 0.25 / (arcs * arcs))});
            }
        }
        p = {wrap_index(p.x + line.step.x, field.width()), wrap_index(p.y + line.step.y, field.height())};
        at += 1;
    } while (p != start);
}

// Sweeps a ring once, backward from its highest point: what lies behind that, seen from before it, never shows. Keeps the upper hull
// of what lies ahead, nearest last; the tangent from a new point touches it where the popping ends.
void sweep(const std::vector<Point>& points, double steps, double to_slope, std::vector<Point>& hull) {
    const auto top = std::ranges::max_element(points, {}, &Point::height);
    hull.clear();
    const auto add = [&](const Point& p) {
        while (hull.size() >= 2) {
            const Point& a = hull.back();
            const Point& b = hull[hull.size() - 2];
            if ((a.height - p.height) * (b.at - p.at) > (b.height - p.height) * (a.at - p.at)) break;
            hull.pop_back();
        }
        if (p.code != nullptr) *p.code = hull.empty() ? 0.0f : horizon_code(std::max(slope(p, hull.back()), 0.0) * to_slope);
        hull.push_back(p);
    };
    for (auto it = top + 1; it != points.begin();) add(*--it);
    for (auto it = points.end(); it != top + 1;) {
        --it;
        add({it->at - steps, it->height, it->code});
    }
}

}  // namespace

Vec2i horizon_step(int direction) {
    assert(direction >= 0 && direction < horizon_directions);
    constexpr int quarter_directions = horizon_directions / 4;
    constexpr Vec2i first[quarter_directions] = {{4, 0}, {4, 1}, {4, 2}, {4, 3}, {4, 4}, {3, 4}, {2, 4}, {1, 4}};
    Vec2i step = first[direction % quarter_directions];
    for (int quarter = direction / quarter_directions; quarter > 0; --quarter) step = {-step.y, step.x};
    return step;
}

ImageF horizon_map(const HeightField& field, int threads, const Progress& progress) {
    assert(!field.empty());
    const int width = field.width();
    const int height = field.height();
    ImageF map(width, height, horizon_directions);

    // Steps of one direction lead from any texel back to it: a ring. Rings are independent.
    struct Ring {
        int direction;
        Vec2i start;
    };
    std::vector<Line> lines;
    std::vector<Ring> rings;
    for (int d = 0; d < horizon_directions; ++d) {
        lines.push_back(line_of(d, width, height));
        const Vec2i step = lines.back().step;
        std::vector<bool> seen(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
        for (int j = 0; j < height; ++j)
            for (int i = 0; i < width; ++i) {
                const auto index = [&](Vec2i p) { return static_cast<std::size_t>(p.y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(p.x); };
                Vec2i p{i, j};
                if (seen[index(p)]) continue;
                rings.push_back({d, p});
                for (; !seen[index(p)]; p = {wrap_index(p.x + step.x, width), wrap_index(p.y + step.y, height)}) seen[index(p)] = true;
            }
    }

    const auto body = [&](int begin, int end) {
        std::vector<Point> points;
        std::vector<Point> hull;
        for (int r = begin; r < end; ++r) {
            const Ring& ring = rings[static_cast<std::size_t>(r)];
            const Line& line = lines[static_cast<std::size_t>(ring.direction)];
            gather(field, line, ring.start, ring.direction, map, points);
            const double steps = std::floor(points.back().at) + 1;
            sweep(points, steps, 1 / line.length_uv, hull);
        }
    };
    parallel_for(static_cast<int>(rings.size()), 8, threads, body, progress, "horizon map");
    return map;
}

}  // namespace relievo
