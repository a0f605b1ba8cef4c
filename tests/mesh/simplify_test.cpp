#include "mesh/simplify.h"

#include "mesh/hausdorff.h"
#include "mesh/made_up_scan.h"
#include "mesh/shapes.h"
#include "mesh/topology.h"
#include "mesh/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace relievo {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

TEST(TriangleTree, NearestPointsOfOneTriangle) {
    const Vec3d a(0, 0, 0), b(4, 0, 0), c(0, 3, 0);
    EXPECT_EQ(nearest_on_triangle({1, 1, 5}, a, b, c), Vec3d(1, 1, 0));    // above
    EXPECT_EQ(nearest_on_triangle({-1, -2, 1}, a, b, c), Vec3d(0, 0, 0));  // beyond a corner
    EXPECT_EQ(nearest_on_triangle({2, -2, 0}, a, b, c), Vec3d(2, 0, 0));   // beyond a side
    EXPECT_LT(length(nearest_on_triangle({4 + 3, 3 + 4, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}) - Vec3d(4, 3, 0)), 1e-12);
    EXPECT_EQ(nearest_on_triangle({1, 1, 0}, a, {2, 0, 0}, b), Vec3d(1, 0, 0));  // no area: a line
    EXPECT_EQ(nearest_on_triangle({1, 1, 0}, a, a, a), a);
}

TEST(TriangleTree, AsByTryingAllTriangles) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(-1.5, 1.5);
    const Mesh mesh = test::torus(20, 9);
    const TriangleTree tree(mesh);
    for (int i = 0; i < 500; ++i) {
        const Vec3d p(unit(random), unit(random), unit(random));
        double best = unbounded;
        for (std::size_t f = 0; f < mesh.faces(); ++f) {
            const auto corner = [&](std::size_t k) { return Vec3d(mesh.positions[mesh.indices[f * 3 + k]]); };
            const Vec3d d = p - nearest_on_triangle(p, corner(0), corner(1), corner(2));
            best = std::min(best, dot(d, d));
        }
        EXPECT_EQ(tree.distance2(p, unbounded), best);
        EXPECT_EQ(tree.distance2(p, best / 2), best / 2);
    }
}

TEST(SurfaceDistance, KnownOnes) {
    const Mesh plane = test::grid(4);
    EXPECT_EQ(surface_distance(plane, plane).largest, 0);
    EXPECT_NEAR(surface_distance(plane, test::moved(plane, {0, 0, 0.5f})).largest, 0.5, 1e-12);
    EXPECT_NEAR(surface_distance(plane, test::moved(plane, {0, 0, 0.5f})).root_mean_square, 0.5, 1e-12);
    // A part of it is no distance away from the whole, but the whole is from the part.
    Mesh half = plane;
    half.indices.resize(half.indices.size() / 2);  // the rows up to y = 2
    const SurfaceDistance d = surface_distance(half, plane);
    EXPECT_NEAR(d.from_first, 0, 1e-12);
    EXPECT_NEAR(d.from_second, 2, 1e-12);
    EXPECT_EQ(d.largest, d.from_second);
    EXPECT_NEAR(d.mean_from_second, 0.5, 0.03);  // half of it at 0, half evenly in [0,2]
    // The octahedron in the sphere: the middles of its faces are nearest to the origin, 1 / sqrt(3).
    EXPECT_NEAR(surface_distance(test::sphere(4), test::sphere(0), 4000).largest, 1 - 1 / std::sqrt(3.0), 5e-3);
    EXPECT_EQ(surface_distance(half, plane, 50000, 1).mean_from_second, surface_distance(half, plane, 50000, 5).mean_from_second);
}

TEST(Simplify, ReachesCounts) {
    const Mesh scan = made_up_scan({.faces = 20000});
    double before = 0;
    for (const std::size_t wanted : {10000u, 3851u, 948u}) {
        const SimplifiedMesh coarse = simplified(scan, {.faces = wanted});
        EXPECT_NEAR(static_cast<double>(coarse.mesh.faces()), static_cast<double>(wanted), 0.01 * static_cast<double>(wanted));
        const Topology t = topology(coarse.mesh);
        EXPECT_EQ(t.boundary_edges, 0u);
        EXPECT_EQ(t.unreferenced_vertices, 0u);
        const double error = surface_distance(scan, coarse.mesh, 20000).largest;
        EXPECT_GT(error, before);  // coarser is farther
        EXPECT_LT(error, 0.2);
        before = error;
    }
}

TEST(Simplify, ReachesErrors) {
    const Mesh ball = test::sphere(5);
    std::size_t before = ball.faces();
    for (const double error : {0.001, 0.01}) {
        const SimplifiedMesh coarse = simplified(ball, {.error = error});
        EXPECT_LT(coarse.mesh.faces(), before);
        EXPECT_LE(coarse.estimated_error, 2 * error * (1 + 1e-5));
        // Quadrics measure distances to planes, which on a smooth surface is close to the truth.
        EXPECT_LT(surface_distance(ball, coarse.mesh, 20000).largest, 3 * 2 * error);
        before = coarse.mesh.faces();
    }
    // A flat sheet needs two triangles, or few more.
    const SimplifiedMesh flat = simplified(test::grid(30), {.error = 1e-4});
    EXPECT_LT(flat.mesh.faces(), 200u);
    EXPECT_LT(surface_distance(test::grid(30), flat.mesh, 20000).largest, 1e-3 * 30);
}

// Clusters first: the count is reached all the same, vertices stay those of the mesh, and it is about as near.
TEST(Simplify, FastReachesCountsToo) {
    const Mesh scan = made_up_scan({.faces = 60000});
    for (const std::size_t wanted : {3000u, 700u}) {
        const SimplifiedMesh fast = simplified(scan, {.faces = wanted, .fast = true}), slow = simplified(scan, {.faces = wanted});
        EXPECT_NEAR(static_cast<double>(fast.mesh.faces()), static_cast<double>(wanted), 0.02 * static_cast<double>(wanted));
        EXPECT_NE(fast.mesh.indices, slow.mesh.indices);
        for (const Vec3f& p : fast.mesh.positions) ASSERT_NE(std::ranges::find(scan.positions, p), scan.positions.end());
        EXPECT_LT(surface_distance(scan, fast.mesh, 20000).root_mean_square, 2 * surface_distance(scan, slow.mesh, 20000).root_mean_square);
    }
    EXPECT_EQ(simplified(test::sphere(4), {.faces = 1000, .fast = true}).mesh.indices, simplified(test::sphere(4), {.faces = 1000}).mesh.indices);  // not many more
}

TEST(Simplify, SeamsDoNotHoldItUp) {
    Mesh list = test::as_list(test::sphere(4));
    for (std::size_t v = 0; v < list.positions.size(); ++v) list.uvs.emplace_back(static_cast<float>(v), 0.0f);  // every corner a seam
    const SimplifiedMesh coarse = simplified(list, {.faces = 300});
    EXPECT_NEAR(static_cast<double>(coarse.mesh.faces()), 300, 3);
}

TEST(Simplify, AsksForNothingItCannotGive) {
    const Mesh cube = test::cube();
    EXPECT_EQ(simplified(cube, {.faces = 12}).mesh.indices, cube.indices);
    EXPECT_EQ(simplified(cube, {.faces = 500}).mesh.indices, cube.indices);
    EXPECT_TRUE(simplified(Mesh{}, {.faces = 5}).mesh.indices.empty());
}

}  // namespace
}  // namespace relievo
