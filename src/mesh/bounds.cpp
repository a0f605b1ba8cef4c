#include "mesh/bounds.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <vector>

namespace relievo {

namespace {

constexpr int grain = 65536;

struct Farthest {
    double distance2 = -1;
    std::size_t index = 0;
};

// The point farthest from `centre`, the first of several.
Farthest farthest_point(std::span<const Vec3f> points, Vec3d centre, int threads) {
    Farthest all;
    std::mutex lock;
    parallel_for(static_cast<int>(points.size()), grain, threads, [&](int begin, int end) {
        Farthest mine;
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
            const Vec3d d = Vec3d(points[i]) - centre;
            const double d2 = dot(d, d);
            if (d2 > mine.distance2) mine = {d2, i};
        }
        const std::lock_guard guard(lock);
        if (mine.distance2 > all.distance2 || (mine.distance2 == all.distance2 && mine.index < all.index)) all = mine;
    });
    return all;
}

// The sphere with all of one to four points on it and its centre in their affine hull; none where they are affinely dependent.
// Gaertner (1999), "Fast and Robust Smallest Enclosing Balls", section 2: the centre is q0 + sum l_i (q_i - q0), where the l_i
// solve a linear system of dot products.
std::optional<Sphere> sphere_through(std::span<const Vec3d> q) {
    assert(!q.empty() && q.size() <= 4);
    const std::size_t m = q.size() - 1;
    double a[3][4] = {};
    Vec3d side[3];
    for (std::size_t i = 0; i < m; ++i) side[i] = q[i + 1] - q[0];
    for (std::size_t i = 0; i < m; ++i) {
        for (std::size_t j = 0; j < m; ++j) a[i][j] = 2 * dot(side[i], side[j]);
        a[i][m] = dot(side[i], side[i]);
    }
    // Gauss with pivots; a pivot far below the sides' lengths means that the points span less than they should.
    for (std::size_t c = 0; c < m; ++c) {
        std::size_t p = c;
        for (std::size_t r = c + 1; r < m; ++r)
            if (std::abs(a[r][c]) > std::abs(a[p][c])) p = r;
        if (!(std::abs(a[p][c]) > 1e-12 * dot(side[c], side[c]))) return std::nullopt;
        for (std::size_t k = 0; k <= m; ++k) std::swap(a[p][k], a[c][k]);
        for (std::size_t r = 0; r < m; ++r) {
            if (r == c) continue;
            const double f = a[r][c] / a[c][c];
            for (std::size_t k = c; k <= m; ++k) a[r][k] -= f * a[c][k];
        }
    }
    Vec3d from_first{};
    for (std::size_t i = 0; i < m; ++i) from_first += side[i] * (a[i][m] / a[i][i]);
    return Sphere{q[0] + from_first, length(from_first)};
}

}  // namespace

Box bounding_box(std::span<const Vec3f> points, int threads) {
    if (points.empty()) return {};
    Box all{points[0], points[0]};
    std::mutex lock;
    parallel_for(static_cast<int>(points.size()), grain, threads, [&](int begin, int end) {
        Vec3f low = points[static_cast<std::size_t>(begin)], high = low;
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
            const Vec3f p = points[i];
            low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
            high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        }
        const std::lock_guard guard(lock);
        all.low = {std::min(all.low.x, low.x), std::min(all.low.y, low.y), std::min(all.low.z, low.z)};
        all.high = {std::max(all.high.x, high.x), std::max(all.high.y, high.y), std::max(all.high.z, high.z)};
    });
    return all;
}

// The smallest sphere is held by at most four points on it. As in Gaertner's pivoting, the point that sticks out most joins them and
// the smallest sphere around these five at most is found by trying every subset with the new point on the sphere: Welzl (1991) says
// that it is on it. The radius grows strictly, so no set of holders returns; a few passes over the points are enough in practice.
Sphere bounding_sphere(std::span<const Vec3f> points, int threads) {
    if (points.empty()) return {};
    std::vector<Vec3d> holders{Vec3d(points[0])};
    Sphere sphere{holders[0], 0};
    for (;;) {
        const Farthest f = farthest_point(points, sphere.centre, threads);
        const double reach = std::sqrt(f.distance2);
        if (!(reach > sphere.radius * (1 + 1e-12))) return {sphere.centre, reach};
        const Vec3d joining(points[f.index]);
        std::optional<Sphere> best;
        std::vector<Vec3d> best_holders;
        for (unsigned subset = 0; subset < 1u << holders.size(); ++subset) {
            std::vector<Vec3d> tried{joining};
            for (std::size_t i = 0; i < holders.size(); ++i)
                if (subset >> i & 1u) tried.push_back(holders[i]);
            if (tried.size() > 4) continue;
            const auto s = sphere_through(tried);
            if (!s || (best && s->radius >= best->radius)) continue;
            const double limit = s->radius * (1 + 1e-11);
            if (std::ranges::all_of(holders, [&](Vec3d p) { return length(p - s->centre) <= limit; })) {
                best = s;
                best_holders = tried;
            }
        }
        // Rounding may leave no progress: then the sphere at hand, blown up to the last point, is the answer within rounding.
        if (!best || !(best->radius > sphere.radius)) return {sphere.centre, reach};
        sphere = *best;
        holders = best_holders;
    }
}

Mesh centred(Mesh mesh, int threads) {
    const Vec3d centre = bounding_box(mesh.positions, threads).centre();
    parallel_for(static_cast<int>(mesh.positions.size()), grain, threads, [&](int begin, int end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
            mesh.positions[i] = Vec3f(Vec3d(mesh.positions[i]) - centre);
    });
    return mesh;
}

}  // namespace relievo
