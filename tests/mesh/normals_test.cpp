#include "mesh/normals.h"

#include "mesh/made_up_scan.h"
#include "mesh/shapes.h"
#include "mesh/topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace relievo {
namespace {

constexpr NormalMode modes[] = {NormalMode::sum, NormalMode::distinct, NormalMode::angle};

Mesh extruded(Mesh mesh, NormalMode mode, float height) {
    const std::vector<Vec3f> n = continuous_normals(mesh, mode);
    for (std::size_t v = 0; v < n.size(); ++v) mesh.positions[v] += n[v] * height;
    return mesh;
}

// How far the eight corners of an extruded cube are from those of a larger cube.
double crookedness(const Mesh& cube) {
    double worst = 0;
    for (const Vec3f& p : cube.positions) {
        const double x = std::abs(p.x), y = std::abs(p.y), z = std::abs(p.z);
        worst = std::max({worst, std::abs(x - y), std::abs(y - z)});
    }
    return worst;
}

// The figure of the 2009 thesis that the mode is named after: at most corners one side of the cube has two triangles and another one.
TEST(Normals, ExtrudedCubeKeepsStraightSidesWhereNormalsCountOnce) {
    for (const float height : {0.1f, 1.0f, 20.0f}) {
        EXPECT_LT(crookedness(extruded(test::as_list(test::cube()), NormalMode::distinct, height)), 1e-6 * (1 + height));
        EXPECT_LT(crookedness(extruded(test::as_list(test::cube()), NormalMode::angle, height)), 1e-6 * (1 + height));
        EXPECT_GT(crookedness(extruded(test::as_list(test::cube()), NormalMode::sum, height)), 0.2 * height);
    }
}

// The same with the normals of one side differing by the rounding of its corners.
TEST(Normals, DistinctForgivesRounding) {
    Mesh tilted = test::as_list(test::cube());
    for (Vec3f& p : tilted.positions) {
        const Vec3d q(p);
        p = Vec3f(Vec3d(0.36 * q.x + 0.48 * q.y - 0.8 * q.z, -0.8 * q.x + 0.6 * q.y, 0.48 * q.x + 0.64 * q.y + 0.6 * q.z) * 0.1 + Vec3d(7, 11, 13));
    }
    const std::vector<Vec3f> n = continuous_normals(tilted, NormalMode::distinct);
    for (std::size_t v = 0; v < n.size(); ++v) {
        const Vec3d outwards = normalize(Vec3d(tilted.positions[v]) - Vec3d(7, 11, 13));
        EXPECT_GT(dot(Vec3d(n[v]), outwards), 1 - 1e-5);
    }
}

TEST(Normals, OfASphereAreItsRadii) {
    const Mesh ball = test::sphere(5);
    for (const NormalMode mode : modes) {
        const std::vector<Vec3f> n = continuous_normals(ball, mode);
        double worst = 1;
        for (std::size_t v = 0; v < n.size(); ++v) worst = std::min(worst, static_cast<double>(dot(n[v], ball.positions[v])));
        EXPECT_GT(worst, std::cos(0.02)) << static_cast<int>(mode);
    }
}

TEST(Normals, OfAPlaneAreExact) {
    for (const NormalMode mode : modes)
        for (const Vec3f& n : continuous_normals(test::grid(3), mode)) EXPECT_EQ(n, Vec3f(0, 0, 1));
}

// A pyramid over a square whose base corner sees one side cut into 1, 2 or 5 triangles: by angle, all the same.
TEST(Normals, ByAngleDoNotDependOnTheTriangulation) {
    const auto corner_normal = [](std::uint32_t cuts, NormalMode mode) {
        Mesh mesh;
        mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
        mesh.indices = {0, 2, 1};  // a wall
        for (std::uint32_t i = 0; i <= cuts; ++i) {
            const double a = std::numbers::pi / 2 * i / cuts;
            mesh.positions.emplace_back(static_cast<float>(std::cos(a)), static_cast<float>(std::sin(a)), 0.0f);
        }
        for (std::uint32_t i = 0; i < cuts; ++i) mesh.indices.insert(mesh.indices.end(), {0, 4 + i, 3 + i});  // the floor
        return continuous_normals(mesh, mode)[0];
    };
    const Vec3f one = corner_normal(1, NormalMode::angle), five = corner_normal(5, NormalMode::angle);
    EXPECT_LT(length(one - five), 1e-6);
    EXPECT_LT(length(one - normalize(Vec3f(0, -1, -1))), 1e-6);
    EXPECT_GT(length(corner_normal(1, NormalMode::sum) - corner_normal(5, NormalMode::sum)), 0.3);
    EXPECT_LT(length(corner_normal(1, NormalMode::distinct) - corner_normal(5, NormalMode::distinct)), 1e-6);
}

TEST(Normals, ClosedMeshesStayClosedAtAnyHeight) {
    const Mesh scan = made_up_scan({.faces = 5000});
    for (const Mesh& closed : {test::as_list(test::cube()), test::as_list(test::torus(12, 8)), test::as_list(scan)})
        for (const NormalMode mode : modes)
            for (const float height : {-0.01f, 0.05f, 0.7f, 1000.0f}) {
                // What vertices share a place before the extrusion share one after it, so no gap can open; compared by number of edges.
                const Mesh outer = extruded(closed, mode, height);
                const Topology before = topology(closed), after = topology(outer);
                EXPECT_EQ(after.boundary_edges, 0u) << height;
                EXPECT_TRUE(before.closed);
                std::size_t gaps = 0;
                const std::vector<Vec3f> n = continuous_normals(closed, mode);
                std::map<std::array<float, 3>, Vec3f> at;
                for (std::size_t v = 0; v < n.size(); ++v) {
                    const Vec3f p = closed.positions[v];
                    const auto [it, fresh] = at.try_emplace({p.x, p.y, p.z}, n[v]);
                    gaps += !fresh && !(it->second == n[v]);
                }
                EXPECT_EQ(gaps, 0u);
            }
}

TEST(Normals, OfWhatHasNone) {
    // Both sides of a sheet cancel; the larger face decides. A face without area has no say, and a vertex with no other has no normal.
    const Mesh sheet = test::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}, {6, 6, 6}, {7, 7, 7}, {0, -3, 0}, {-3, 0, 0}, {9, 9, 9}},
                                     {0, 1, 2, 0, 6, 7, 0, 3, 4, 3, 4, 5});
    for (const NormalMode mode : modes) {
        Mesh both = sheet;
        both.indices.insert(both.indices.end(), {0, 2, 1, 1, 0, 2});
        const std::vector<Vec3f> n = continuous_normals(both, mode);
        for (const Vec3f& v : n) EXPECT_TRUE(std::abs(length(v) - 1) < 1e-5 || v == Vec3f()) << v.x << ' ' << v.y << ' ' << v.z;
        EXPECT_EQ(n[4], Vec3f());
        EXPECT_EQ(n[8], Vec3f());
    }
    const Mesh two_sided = test::mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 1});
    for (const NormalMode mode : modes)
        for (const Vec3f& v : continuous_normals(two_sided, mode)) EXPECT_EQ(v, Vec3f(0, 0, 1)) << "the first of equal faces";
}

TEST(Normals, TinyAndHugeMeshes) {
    for (const float scale : {1e-18f, 1e-6f, 1e6f, 1e17f})
        for (const NormalMode mode : modes) {
            Mesh mesh = test::cube();
            for (Vec3f& p : mesh.positions) p *= scale;
            const std::vector<Vec3f> n = continuous_normals(mesh, mode), reference = continuous_normals(test::cube(), mode);
            for (std::size_t v = 0; v < n.size(); ++v) EXPECT_LT(length(n[v] - reference[v]), 1e-5) << scale;
        }
}

TEST(Normals, AnyThreads) {
    const Mesh scan = test::as_list(made_up_scan({.faces = 20000}));
    for (const NormalMode mode : modes) {
        const std::vector<Vec3f> one = continuous_normals(scan, mode, 1);
        EXPECT_EQ(one, continuous_normals(scan, mode, 2));
        EXPECT_EQ(one, continuous_normals(scan, mode, 7));
    }
}

}  // namespace
}  // namespace relievo
