// Charts and walks over them: on shapes whose charts are known, and against the outline of a square.
#include "mesh/charts.h"
#include "mesh/made_up_atlas.h"
#include "mesh/relief_rays.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

namespace relievo {
namespace {

TEST(Charts, AreThePiecesOfTheAtlas) {
    const std::map<std::string_view, std::size_t> charts{{"cube", 6}, {"cylinder", 3}, {"torus", 4}};
    for (const UnwrappedShape& shape : unwrapped_shapes()) EXPECT_EQ(find_charts(shape.make()).count, charts.at(shape.id)) << shape.id;
}

// Flat charts have one scale; what bends has its mean.
TEST(Charts, KnowHowLargeTheyAreDrawn) {
    const Charts cube = find_charts(find_unwrapped_shape("cube")->make());
    for (const double scale : cube.scale) EXPECT_NEAR(scale, 1 / 0.3, 1e-5);
    const Charts cylinder = find_charts(find_unwrapped_shape("cylinder")->make());
    for (const double scale : cylinder.scale) EXPECT_NEAR(scale, std::numbers::pi / 0.96, 2e-3);
}

TEST(Charts, EndWhereTheTextureIsMirrored) {
    // Two triangles of one square, the second folded back over the first in the picture.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {1, 0.2f}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    EXPECT_EQ(find_charts(mesh).count, 2u);
    mesh.uvs[3] = {0, 1};
    EXPECT_EQ(find_charts(mesh).count, 1u);
}

// Vertices that are doubled for their normals alone do not cut a chart; another place in the picture does.
TEST(Charts, AreCutByTheTextureAlone) {
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}};
    mesh.indices = {0, 1, 2, 3, 4, 5};
    EXPECT_EQ(find_charts(mesh).count, 1u);
    mesh.uvs[3] = {0.01f, 0};
    EXPECT_EQ(find_charts(mesh).count, 2u);
}

TEST(ChartWalk, LeavesTheSquareWhereTheOutlineIs) {
    const Mesh mesh = find_unwrapped_shape("cube")->make();
    const Charts charts = find_charts(mesh);
    std::mt19937 random(4);
    const auto unit = [&] { return static_cast<double>(random() >> 8) / 16777216.0; };
    int left = 0;
    for (int k = 0; k < 4000; ++k) {
        const auto face = static_cast<std::uint32_t>(random() % mesh.faces());
        const std::uint32_t* c = &mesh.indices[std::size_t{face} * 3];
        double a = unit(), b = unit();
        if (a + b > 1) a = 1 - a, b = 1 - b;
        const Vec2d from = Vec2d(mesh.uvs[c[0]]) * (1 - a - b) + Vec2d(mesh.uvs[c[1]]) * a + Vec2d(mesh.uvs[c[2]]) * b;
        const Vec2d way{unit() - 0.5, unit() - 0.5};
        // The square of the face's chart.
        Vec2d low{9, 9}, high{-9, -9};
        for (std::size_t f = 0; f < mesh.faces(); ++f)
            if (charts.of_face[f] == charts.of_face[face])
                for (int i = 0; i < 3; ++i) {
                    const Vec2d p(mesh.uvs[mesh.indices[f * 3 + static_cast<std::size_t>(i)]]);
                    low = {std::min(low.x, p.x), std::min(low.y, p.y)}, high = {std::max(high.x, p.x), std::max(high.y, p.y)};
                }
        const double until_x = way.x > 0 ? (high.x - from.x) / way.x : (low.x - from.x) / way.x;
        const double until_y = way.y > 0 ? (high.y - from.y) / way.y : (low.y - from.y) / way.y;
        const double expected = std::min({1.0, until_x, until_y});
        const ChartWalk walk = walk_chart(mesh, charts, face, from, way);
        ASSERT_NEAR(walk.share, expected, 1e-6) << k;
        EXPECT_EQ(charts.of_face[walk.face], charts.of_face[face]);
        left += expected < 1 ? 1 : 0;
    }
    EXPECT_GT(left, 1000);
}

// On a bent chart the walk comes back by the way it went, through many faces.
TEST(ChartWalk, ComesBack) {
    const Mesh mesh = find_unwrapped_shape("torus")->make();
    const Charts charts = find_charts(mesh);
    std::mt19937 random(5);
    int far = 0;
    for (int k = 0; k < 1000; ++k) {
        const auto face = static_cast<std::uint32_t>(random() % mesh.faces());
        const std::uint32_t* c = &mesh.indices[std::size_t{face} * 3];
        const Vec2d from = (Vec2d(mesh.uvs[c[0]]) + Vec2d(mesh.uvs[c[1]]) + Vec2d(mesh.uvs[c[2]])) / 3.0;
        const double angle = k * 0.7;
        const Vec2d way = Vec2d{std::cos(angle), std::sin(angle)} * 0.07;
        const ChartWalk there = walk_chart(mesh, charts, face, from, way);
        if (there.share < 1) continue;
        const ChartWalk back = walk_chart(mesh, charts, there.face, from + way, -way);
        EXPECT_EQ(back.share, 1);
        EXPECT_EQ(back.face, face);
        far += there.face != face ? 1 : 0;
    }
    EXPECT_GT(far, 400);
}

// --- rays ------------------------------------------------------------------------------------------------------------------

// On a cube's side the texture is neither turned nor stretched: what a ray gains per height follows from plain geometry.
TEST(ReliefRays, AreThoseOfAFlatBaseOnACube) {
    const Mesh mesh = find_unwrapped_shape("cube")->make();
    const Charts charts = find_charts(mesh);
    Camera camera;
    camera.up = {0, 1, 0};
    camera.eye = {0.4, 0.6, 3};
    camera.fov_y_rad = 0.4;
    const MeshRays rays = relief_rays(mesh, charts, camera, {.width = 64, .height = 48, .repeats = 2, .height_scale = 0.05, .zero_level = 1});
    std::set<std::uint32_t> seen;
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 64; ++x) {
            if (rays.rays.coverage(x, y) == 0) continue;
            const std::uint32_t face = rays.face[static_cast<std::size_t>(y * 64 + x)];
            seen.insert(charts.of_face[face]);
            const Vec3d p{rays.position(x, y, 0), rays.position(x, y, 1), rays.position(x, y, 2)};
            const Vec3d v = normalize(camera.eye - p);
            EXPECT_NEAR(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 0.5, 1e-5);
            if (p.z < 0.499) continue;  // the front: u along x, v along y, 0.6 repeats over the edge
            EXPECT_NEAR(static_cast<double>(rays.amplitude(x, y)), 0.05 / 0.6, 1e-6);
            const double per_height = static_cast<double>(rays.height_scale(x, y)) / static_cast<double>(rays.rays.view(x, y, 2));
            EXPECT_NEAR(static_cast<double>(rays.rays.view(x, y, 0)) * per_height, 0.05 * v.x / v.z, 1e-5);
            EXPECT_NEAR(static_cast<double>(rays.rays.view(x, y, 1)) * per_height, 0.05 * v.y / v.z, 1e-5);
            // Straight down to the floor, or until the ray has left the front.
            const Vec2d moved = Vec2d{-v.x, -v.y} * (0.05 / 0.6 / v.z);
            double stays = 1;
            for (const auto& [at, by] : {std::pair{p.x, moved.x}, std::pair{p.y, moved.y}})
                if (std::abs(at + by) > 0.5) stays = std::min(stays, ((by > 0 ? 0.5 : -0.5) - at) / by);
            EXPECT_NEAR(static_cast<double>(rays.range(x, y, 1)), 1 - stays, 1e-4);
            EXPECT_EQ(rays.range(x, y, 0), 1.0f);
        }
    }
    EXPECT_EQ(seen.size(), 2u) << "the front and the top";
}

// Sheared and stretched texture: the gradients bring a step on the mesh to the same place in the picture.
TEST(ReliefRays, KnowAShearedTexture) {
    Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    const auto uv = [](Vec2d p) { return Vec2d{0.4 + 0.2 * p.x + 0.1 * p.y, 0.5 - 0.05 * p.x + 0.15 * p.y}; };
    for (const Vec3f& p : mesh.positions) mesh.uvs.push_back(Vec2f(uv({p.x, p.y})));
    mesh.indices = {0, 1, 2, 0, 2, 3};
    Camera camera;
    camera.eye = {1, -2, 2};
    const MeshRays rays = relief_rays(mesh, find_charts(mesh), camera, {.width = 32, .height = 32, .height_scale = 0.1, .zero_level = 0.5, .ends_with_chart = false});
    int hits = 0;
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            if (rays.rays.coverage(x, y) == 0) continue;
            ++hits;
            const Vec3d p{rays.position(x, y, 0), rays.position(x, y, 1), rays.position(x, y, 2)};
            EXPECT_NEAR(static_cast<double>(rays.rays.uv(x, y, 0)), uv({p.x, p.y}).x, 1e-6);
            // A quarter of the relief higher, the ray is over another point of the plane.
            const Vec3d v = normalize(camera.eye - p);
            const Vec3d q = p + v * (0.25 * static_cast<double>(rays.amplitude(x, y)) / v.z);
            const double per_height = static_cast<double>(rays.height_scale(x, y)) / static_cast<double>(rays.rays.view(x, y, 2));
            EXPECT_NEAR(static_cast<double>(rays.rays.uv(x, y, 0)) + 0.25 * static_cast<double>(rays.rays.view(x, y, 0)) * per_height, uv({q.x, q.y}).x, 1e-5);
            EXPECT_NEAR(static_cast<double>(rays.rays.uv(x, y, 1)) + 0.25 * static_cast<double>(rays.rays.view(x, y, 1)) * per_height, uv({q.x, q.y}).y, 1e-5);
        }
    }
    EXPECT_GT(hits, 200);
}

}  // namespace
}  // namespace relievo
