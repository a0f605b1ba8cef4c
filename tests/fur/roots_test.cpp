// Roots against what a Poisson-disk sample of a surface promises, counted without the grid that made them.
#include "fur/roots.h"

#include "core/error.h"
#include "fur/facing.h"
#include "mesh/made_up_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

namespace relievo {
namespace {

// A square of edge 1 in the plane z = 0, cut into n x n squares of two faces.
Mesh sheet(std::uint32_t n) {
    Mesh mesh;
    for (std::uint32_t y = 0; y <= n; ++y)
        for (std::uint32_t x = 0; x <= n; ++x) mesh.positions.emplace_back(static_cast<float>(x) / static_cast<float>(n), static_cast<float>(y) / static_cast<float>(n), 0.0f);
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x, b = a + n + 1;
            mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    return mesh;
}

// The least distance between roots whose faces look the same way, by sweeping along x.
double least_distance(const Mesh& mesh, const Roots& roots, double no_more_than) {
    std::vector<Root> sorted = roots.roots;
    std::ranges::sort(sorted, {}, [](const Root& r) { return r.position.x; });
    double least = no_more_than;
    for (std::size_t i = 0; i < sorted.size(); ++i)
        for (std::size_t j = i + 1; j < sorted.size() && sorted[j].position.x - sorted[i].position.x < least; ++j)
            if (dot(face_vector(mesh, sorted[i].face), face_vector(mesh, sorted[j].face)) > 0)
                least = std::min(least, length(Vec3d(sorted[i].position) - Vec3d(sorted[j].position)));
    return least;
}

using Place = std::array<float, 3>;
std::vector<Place> places_of(const Roots& roots) {
    std::vector<Place> all;
    for (const Root& r : roots.roots) all.push_back({r.position.x, r.position.y, r.position.z});
    std::ranges::sort(all);
    return all;
}

void expect_same(const Roots& a, const Roots& b) {
    ASSERT_EQ(a.roots.size(), b.roots.size());
    for (std::size_t i = 0; i < a.roots.size(); ++i) {
        ASSERT_EQ(a.roots[i].position, b.roots[i].position) << i;
        ASSERT_EQ(a.roots[i].face, b.roots[i].face) << i;
    }
}

TEST(Roots, KeepTheirDistanceAndLeaveNoGaps) {
    for (const Mesh& mesh : {sheet(1), sheet(40), made_up_scan({.faces = 20000})}) {
        const Roots roots = grow_roots(mesh, {.count = 5000});
        EXPECT_GE(least_distance(mesh, roots, 2 * roots.distance), roots.distance * (1 - 1e-5));
        EXPECT_LE(least_distance(mesh, roots, 2 * roots.distance), roots.distance * 1.1);  // it is not larger than need be
        // A few more at borders, beyond which nothing competes, and where noise turns neighbouring faces away from each other.
        EXPECT_NEAR(static_cast<double>(roots.roots.size()), 5000, 5000 * 0.09);
    }
    // A disc of 2.5 distances that holds no root would be one into which darts no longer came.
    const Roots roots = grow_roots(sheet(7), {.count = 2000});
    for (int y = 1; y < 60; ++y)
        for (int x = 1; x < 60; ++x) {
            double nearest = 1;
            for (const Root& r : roots.roots) nearest = std::min(nearest, length(Vec3d(r.position) - Vec3d(x / 60.0, y / 60.0, 0)));
            EXPECT_LT(nearest, 2.5 * roots.distance) << x << ' ' << y;
        }
}

TEST(Roots, LieOnTheirFaces) {
    const Mesh mesh = made_up_scan({.faces = 3000});
    const Roots roots = grow_roots(mesh, {.count = 3000});
    for (const Root& r : roots.roots) {
        const Vec3f w = corner_weights(mesh, r);
        EXPECT_GE(std::min({w.x, w.y, w.z}), 0.0f);
        EXPECT_NEAR(w.x + w.y + w.z, 1, 1e-6);
        const std::uint32_t* v = &mesh.indices[std::size_t{r.face} * 3];
        const Vec3f at = mesh.positions[v[0]] * w.x + mesh.positions[v[1]] * w.y + mesh.positions[v[2]] * w.z;
        EXPECT_LT(length(at - r.position), 1e-5);
    }
}

TEST(Roots, AreTheSameForAnyThreads) {
    // One large face among many small ones: it is cut into packs.
    Mesh mesh = made_up_scan({.faces = 30000});
    const auto n = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {{-3, -3, -2}, {3, -3, -2}, {0, 3, -2}});
    mesh.indices.insert(mesh.indices.end(), {n, n + 1, n + 2});
    const Roots one = grow_roots(mesh, {.count = 60000, .threads = 1});
    for (const int threads : {2, 3, 8}) expect_same(grow_roots(mesh, {.count = 60000, .threads = threads}), one);
    EXPECT_NE(places_of(grow_roots(mesh, {.count = 60000, .seed = 2})), places_of(one));
}

TEST(Roots, FollowTheSurfaceAndNotTheFile) {
    const Mesh mesh = made_up_scan({.faces = 4000});
    Mesh other = mesh;
    // Faces in another order, each beginning with another corner.
    std::vector<std::uint32_t> order(mesh.faces());
    for (std::uint32_t f = 0; f < order.size(); ++f) order[f] = f;
    std::mt19937 random(5);
    std::ranges::shuffle(order, random);
    for (std::size_t f = 0; f < order.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) other.indices[f * 3 + k] = mesh.indices[std::size_t{order[f]} * 3 + (k + order[f]) % 3];
    // The sum of areas is rounded in another order, so that a dart more or less may be thrown.
    const auto a = places_of(grow_roots(mesh, {.count = 4000})), b = places_of(grow_roots(other, {.count = 4000}));
    std::vector<Place> common;
    std::ranges::set_intersection(a, b, std::back_inserter(common));
    EXPECT_GE(common.size() + 10, a.size());
}

TEST(Roots, KeepTheirDistanceOnASpeckFarAway) {
    // At ten million the speck has no area left, and what is far from it, which is all, lies in one cell.
    for (const auto& [far, size] : {std::pair{1e3f, 0.1f}, {3e4f, 0.1f}, {1e5f, 0.1f}, {1e7f, 0.1f}, {1e6f, 1e2f}, {1e9f, 1e5f}}) {
        Mesh mesh = sheet(20);
        const auto n = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.insert(mesh.positions.end(), {{-far, 0, 0}, {-far + size, 0, 0}, {-far, size, 0}});
        mesh.indices.insert(mesh.indices.end(), {n, n + 1, n + 2});
        const Roots roots = grow_roots(mesh, {.count = 3000});
        EXPECT_NEAR(static_cast<double>(roots.roots.size()), 3000, 300) << far;
        EXPECT_GE(least_distance(mesh, roots, 2 * roots.distance), roots.distance * (1 - 1e-5)) << far;
        EXPECT_EQ(grow_roots(mesh, {.count = 3000, .threads = 1}).roots.size(), roots.roots.size()) << far;
    }
}

TEST(Roots, FollowACurveOnWhichNeighboursAreNear) {
    const Mesh ball = made_up_scan({.faces = 3000, .relief = 0, .noise = 0});
    const Roots roots = grow_roots(ball, {.count = 5000});
    double along = 0;
    for (std::size_t i = 1; i < roots.roots.size(); ++i) along += length(Vec3d(roots.roots[i].position) - Vec3d(roots.roots[i - 1].position));
    // In a random order steps would be two thirds of the ball's width (4/3 of its radius), 41 distances. A block is 24 wide and few strands long: to and fro in its cells, six wide, is what is left.
    EXPECT_LT(along / static_cast<double>(roots.roots.size() - 1), 6 * roots.distance);
}

TEST(Roots, BothSidesOfAThinSheetHaveTheirOwn) {
    Mesh two = sheet(8);
    const Mesh front = two;
    const auto n = static_cast<std::uint32_t>(two.positions.size());
    for (const Vec3f& p : front.positions) two.positions.emplace_back(p.x, p.y, -1e-4f);
    for (std::size_t i = 0; i < front.indices.size(); i += 3) two.indices.insert(two.indices.end(), {front.indices[i] + n, front.indices[i + 2] + n, front.indices[i + 1] + n});
    const Roots roots = grow_roots(two, {.count = 4000});
    const auto on_front = static_cast<double>(std::ranges::count_if(roots.roots, [](const Root& r) { return r.position.z > -5e-5f; }));
    EXPECT_NEAR(on_front, 2000, 120);
    EXPECT_NEAR(static_cast<double>(roots.roots.size()) - on_front, 2000, 120);
}

TEST(Roots, RepeatedAndEmptyFacesGrowNothing) {
    const Mesh mesh = made_up_scan({.faces = 2000});
    const Roots plain = grow_roots(mesh, {.count = 2000});
    Mesh twice = mesh;
    twice.indices.insert(twice.indices.end(), mesh.indices.begin(), mesh.indices.end());
    // Twice the area for twice the roots wanted: the same distance, and the same places.
    const Roots repeated = grow_roots(twice, {.count = 4000});
    EXPECT_NEAR(static_cast<double>(repeated.roots.size()), static_cast<double>(plain.roots.size()), 60);
    for (const Root& r : repeated.roots) EXPECT_LT(r.face, mesh.faces());

    Mesh slits = mesh;
    for (std::uint32_t f = 0; f < 500; ++f) {
        const auto n = static_cast<std::uint32_t>(slits.positions.size());
        const Vec3f p = mesh.positions[f];
        slits.positions.insert(slits.positions.end(), {p, p + Vec3f(1, 0, 0), p + Vec3f(2, 0, 0)});
        slits.indices.insert(slits.indices.end(), {n, n + 1, n + 2});
    }
    EXPECT_EQ(places_of(grow_roots(slits, {.count = 2000})), places_of(plain));
}

TEST(Roots, GrowOnASingleFaceOfAnySizeAndOnNothingElse) {
    for (const float size : {1e-12f, 1.0f, 1e12f}) {
        Mesh one;
        one.positions = {{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
        one.indices = {0, 1, 2};
        const Roots roots = grow_roots(one, {.count = 1000});
        EXPECT_NEAR(static_cast<double>(roots.roots.size()), 1000, 80) << size;
        EXPECT_GE(least_distance(one, roots, 10 * roots.distance), roots.distance * (1 - 1e-5)) << size;
    }
    Mesh slit;
    slit.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    slit.indices = {0, 1, 2};
    EXPECT_THROW(grow_roots(slit), Error);
    slit.indices.clear();
    EXPECT_THROW(grow_roots(slit), Error);
}

}  // namespace
}  // namespace relievo
