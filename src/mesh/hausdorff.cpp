#include "mesh/hausdorff.h"

#include "core/parallel_for.h"
#include "mesh/triangle_tree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace relievo {

namespace {

// Points spread evenly over a triangle: Roberts' low-discrepancy sequence (2018), folded into the triangle.
Vec2d spread(std::size_t i) {
    constexpr double g = 1.32471795724474602596;  // root of x^3 = x + 1
    double u = std::fmod(0.5 + static_cast<double>(i) / g, 1.0), v = std::fmod(0.5 + static_cast<double>(i) / (g * g), 1.0);
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    return {u, v};
}

std::vector<Vec3d> sample_points(const Mesh& mesh, std::size_t wanted) {
    std::vector<std::uint8_t> used(mesh.positions.size(), 0);
    for (const std::uint32_t v : mesh.indices) used[v] = 1;
    std::vector<Vec3d> points;
    for (std::size_t v = 0; v < used.size(); ++v)
        if (used[v]) points.emplace_back(mesh.positions[v]);
    const auto corner = [&](std::size_t f, std::size_t k) { return Vec3d(mesh.positions[mesh.indices[f * 3 + k]]); };
    double area = 0;
    std::vector<double> up_to(mesh.faces());
    for (std::size_t f = 0; f < mesh.faces(); ++f) up_to[f] = area += length(cross(corner(f, 1) - corner(f, 0), corner(f, 2) - corner(f, 0)));
    if (points.size() >= wanted || !(area > 0)) return points;
    // One sample after each equal share of the area; several that fall on one face are spread over it.
    const std::size_t more = wanted - points.size();
    std::size_t face = 0;
    for (std::size_t i = 0; i < more; ++i) {
        while (face + 1 < up_to.size() && up_to[face] < area * (static_cast<double>(i) + 0.5) / static_cast<double>(more)) ++face;
        const Vec2d uv = spread(i);
        points.push_back(corner(face, 0) + (corner(face, 1) - corner(face, 0)) * uv.x + (corner(face, 2) - corner(face, 0)) * uv.y);
    }
    return points;
}

struct Distances {
    double largest = 0, sum = 0, sum_of_squares = 0;
    std::size_t count = 0;
};

Distances distances(const Mesh& from, const Mesh& to, std::size_t samples, int threads) {
    const std::vector<Vec3d> points = sample_points(from, samples);
    const TriangleTree tree(to);
    std::vector<double> squared(points.size());
    parallel_for(static_cast<int>(points.size()), 1024, threads, [&](int begin, int end) {
        // The last point is near the next one, and so is its distance: a bound that spares most of the tree.
        double last = std::numeric_limits<double>::infinity();
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
            double bound = std::numeric_limits<double>::infinity();
            if (i > static_cast<std::size_t>(begin)) {
                const double step = length(points[i] - points[i - 1]) + std::sqrt(last);
                bound = step * step * (1 + 1e-12) + std::numeric_limits<double>::min();
            }
            squared[i] = last = tree.distance2(points[i], bound);
        }
    });
    Distances d;
    d.count = points.size();
    for (const double s : squared) {
        d.largest = std::max(d.largest, std::sqrt(s));
        d.sum += std::sqrt(s);
        d.sum_of_squares += s;
    }
    return d;
}

}  // namespace

SurfaceDistance surface_distance(const Mesh& first, const Mesh& second, std::size_t samples, int threads) {
    assert(first.faces() > 0 && second.faces() > 0);
    const Distances a = distances(first, second, samples, threads), b = distances(second, first, samples, threads);
    SurfaceDistance d;
    d.from_first = a.largest;
    d.from_second = b.largest;
    d.largest = std::max(a.largest, b.largest);
    d.mean_from_first = a.sum / static_cast<double>(a.count);
    d.mean_from_second = b.sum / static_cast<double>(b.count);
    d.samples = a.count + b.count;
    d.root_mean_square = std::sqrt((a.sum_of_squares + b.sum_of_squares) / static_cast<double>(d.samples));
    return d;
}

}  // namespace relievo
