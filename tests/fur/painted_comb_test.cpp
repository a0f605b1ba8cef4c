// A painted comb, where what it must do is known: on a plane strands lie along what is painted.
#include "fur/painted_comb.h"

#include "core/error.h"
#include "fur/carried_values.h"
#include "fur/comb.h"
#include "fur/refined.h"
#include "fur/strand_curves.h"
#include "mesh/indexing.h"
#include "mesh/made_up_scan.h"
#include "mesh/normals.h"
#include "mesh/simplify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace relievo {
namespace {

// A unit square of y = 0, whose texture's u grows along the x axis turned by an angle toward -z; (u,v) = (0,0) at its corner.
Mesh plane(double angle = 0, int cells = 8) {
    Mesh mesh;
    mesh.name = "plane";
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            const double x = static_cast<double>(i) / cells, z = -static_cast<double>(j) / cells;
            mesh.positions.emplace_back(Vec3d(x, 0, z));
            mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
            mesh.uvs.emplace_back(Vec2d(std::cos(angle) * x - std::sin(angle) * z, -std::sin(angle) * x - std::cos(angle) * z));
        }
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const auto v = static_cast<std::uint32_t>(j * (cells + 1) + i), row = static_cast<std::uint32_t>(cells + 1);
            mesh.indices.insert(mesh.indices.end(), {v, v + 1, v + row, v + 1, v + row + 1, v + row});
        }
    return mesh;
}

CombPaint picture_of(std::initializer_list<int> bytes, int width = 1, int height = 1) {
    const int channels = static_cast<int>(bytes.size());
    ImageF picture(width, height, channels);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) picture(x, y, c) = static_cast<float>(bytes.begin()[c]) / 255;
    return {.file = "paint.png", .picture = std::make_shared<const ImageF>(std::move(picture)), .colours = false};
}

TEST(PaintedComb, LaysStrandsOfAPlaneAlongWhatIsPainted) {
    const Coat coat{.length = 0.2f, .tilt = 0.5f, .bend = 0.7f, .spread = 0, .length_variation = 0, .lock = 0, .guard_hairs = 0};
    const struct {
        int red, green;
        double u, v;
    } directions[] = {{255, 128, 1, 0}, {128, 255, 0, 1}, {1, 128, -1, 0}, {128, 1, 0, -1}, {204, 229, 76.0 / 127, 101.0 / 127}};
    for (const double angle : {0.0, 0.7})
        for (const auto& d : directions) {
            const Mesh mesh = plane(angle);
            const std::vector<PaintedLean> painted = painted_leans(mesh, picture_of({d.red, d.green, 0, 255}));
            const std::vector<Vec3f> comb = combed(mesh, mean_lean(coat), 0, painted);
            Roots roots;
            for (int i = 0; i < 8; ++i) roots.roots.push_back({.position = {(static_cast<float>(i) + 0.25f) / 8, 0, -0.03f}, .face = static_cast<std::uint32_t>(2 * i)});
            const StrandCurves c = strand_curves(mesh, comb, roots, coat, 0.1, 4);
            // u grows along (cos, 0, -sin), v along (-sin, 0, -cos).
            const Vec3d along_u(std::cos(angle), 0, -std::sin(angle)), along_v(-std::sin(angle), 0, -std::cos(angle));
            const Vec3d along = along_u * d.u + along_v * d.v;
            const double strength = length(along), start = 0.5 * strength, bend = 0.7 * strength;
            for (std::size_t s = 0; s < roots.roots.size(); ++s)
                for (int k = 0; k <= 4; ++k) {
                    const double level = k / 4.0, angle_here = start + bend * level;
                    const Vec3d axis = (Vec3d(0, 1, 0) * (std::sin(angle_here) - std::sin(start)) + along / strength * (std::cos(start) - std::cos(angle_here))) / bend;
                    EXPECT_LT(length(Vec3d(c.points[s * 5 + static_cast<std::size_t>(k)]) - Vec3d(roots.roots[s].position) - axis * 0.2), 2e-6) << d.red << ' ' << d.green << ' ' << angle;
                }
        }
}

TEST(PaintedComb, LeavesTheCombWhereItHasNoWeightAndBlendsBetween) {
    const Mesh mesh = plane();
    const std::vector<Vec3f> bare = combed(mesh, 1);
    EXPECT_TRUE(painted_leans(mesh, {}).empty());
    EXPECT_TRUE(painted_leans(mesh, picture_of({255, 128, 255, 0})).empty());
    EXPECT_TRUE(painted_leans(mesh, picture_of({255, 128, 0})).empty());  // without alpha, blue is the weight
    std::vector<PaintedLean> partly = painted_leans(mesh, picture_of({128, 255, 51}));
    for (std::size_t v = 0; v < partly.size(); ++v) {
        EXPECT_NEAR(partly[v].weight, 0.2, 1e-6);
        const Vec3f wanted = bare[v] * 0.8f + Vec3f(0, 0, -0.2f);
        EXPECT_LT(length(combed(mesh, 1, 0, partly)[v] - wanted), 1e-6);
        if (v % 3 == 0) partly[v] = {};
    }
    const std::vector<Vec3f> some = combed(mesh, 1, 0, partly);
    for (std::size_t v = 0; v < partly.size(); v += 3) EXPECT_EQ(some[v], bare[v]);  // to the bit
}

// Left half toward +u, right half not painted: in between the weight falls off, the direction does not.
TEST(PaintedComb, ReadsPicturesBilinearlyAndRepeatsThem) {
    ImageF picture(2, 1, 4);
    const float left[] = {1, 128 / 255.0f, 0, 1}, right[] = {0, 0, 0, 0};
    std::copy_n(left, 4, picture.at(0, 0));
    std::copy_n(right, 4, picture.at(1, 0));
    const CombPaint paint{.file = "half.png", .picture = std::make_shared<const ImageF>(picture), .colours = false};
    Mesh mesh = plane();
    const std::vector<PaintedLean> painted = painted_leans(mesh, paint);
    for (std::size_t v = 0; v < painted.size(); ++v) {
        const double u = static_cast<double>(mesh.uvs[v].x), weight = 1 - 2 * std::min(std::abs(u - 0.25), 1.25 - u);
        EXPECT_NEAR(painted[v].weight, weight, 1e-5) << u;
        EXPECT_NEAR(painted[v].weighted.x, weight, 1e-5) << u;
        EXPECT_NEAR(painted[v].weighted.z, 0, 1e-5) << u;
    }
    for (Vec2f& uv : mesh.uvs) uv = uv + Vec2f(3, -2);
    const std::vector<PaintedLean> again = painted_leans(mesh, paint);
    for (std::size_t v = 0; v < painted.size(); ++v) EXPECT_NEAR(again[v].weight, painted[v].weight, 1e-5);
}

TEST(PaintedComb, TakesVertexColoursForDirectionsInSpace) {
    Mesh ball = made_up_scan({.faces = 800, .relief = 0, .noise = 0});
    ball.normals = continuous_normals(ball, NormalMode::angle);
    ball.colours.assign(ball.positions.size(), Vec3f(128 / 255.0f, 1, 128 / 255.0f));
    const std::vector<PaintedLean> up = painted_leans(ball, {.file = {}, .picture = {}, .colours = true});
    const std::vector<Vec3f> comb = combed(ball, 0, 0, up);
    for (std::size_t v = 0; v < up.size(); ++v) {
        EXPECT_NEAR(up[v].weight, 1, 1e-6);
        const Vec3f n = ball.normals[v], flat = Vec3f(0, 1, 0) - n * n.y;
        EXPECT_NEAR(dot(comb[v], n), 0, 1e-6);
        // Upright where the direction is the normal's, at full strength from 30 degrees off it.
        EXPECT_LT(length(comb[v] - flat * (1 / std::max(length(flat), 0.5f))), 1e-5);
    }
    ball.colours.assign(ball.positions.size(), Vec3f(128 / 255.0f));
    EXPECT_TRUE(painted_leans(ball, {.file = {}, .picture = {}, .colours = true}).empty());
}

// A seam of the texture is none of the skin: where two charts meet, the fur lies one way.
TEST(PaintedComb, IsOneAtEachPlace) {
    Mesh mesh = plane(0, 1);
    // The second face gets corners of its own, whose texture is turned by a right angle.
    for (std::size_t k = 3; k < 6; ++k) {
        const std::uint32_t v = mesh.indices[k];
        mesh.indices[k] = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(Vec3f(mesh.positions[v]));
        mesh.normals.push_back(Vec3f(mesh.normals[v]));
        mesh.uvs.emplace_back(-mesh.uvs[v].y, mesh.uvs[v].x);
    }
    const std::vector<PaintedLean> painted = painted_leans(mesh, picture_of({255, 128, 255}));
    const std::size_t shared = mesh.indices[1], twin = mesh.indices[3];
    ASSERT_EQ(mesh.positions[shared], mesh.positions[twin]);
    EXPECT_EQ(painted[shared].weighted, painted[twin].weighted);
    EXPECT_NEAR(length(painted[shared].weighted), std::sqrt(0.5), 1e-5);  // the mean of two at right angles
    EXPECT_NEAR(length(painted[mesh.indices[0]].weighted), 1, 1e-5);
}

TEST(PaintedComb, RefusesWhatDoesNotFit) {
    Mesh mesh = plane();
    const auto said = [](const Mesh& m, const CombPaint& paint) -> std::string {
        try {
            painted_leans(m, paint);
        } catch (const Error& e) {
            return e.what();
        }
        return "";
    };
    EXPECT_NE(said(mesh, picture_of({255})).find("red, green and blue"), std::string::npos);
    EXPECT_NE(said(mesh, {.file = {}, .picture = {}, .colours = true}).find("no vertex colours"), std::string::npos);
    mesh.uvs.clear();
    EXPECT_NE(said(mesh, picture_of({255, 128, 255})).find("no texture coordinates"), std::string::npos);
}

TEST(PaintedComb, TravelsThroughWhatChangesTheMesh) {
    const Mesh mesh = plane(0, 16);
    std::vector<PaintedLean> painted;
    std::vector<float> lengths;
    for (const Vec3f& p : mesh.positions) {
        painted.push_back({{p.x, 0, p.z}, p.x});
        lengths.push_back(1 - p.x);
    }
    for (const bool fine : {false, true}) {
        Mesh changed = carrying(mesh, lengths, painted);
        changed = fine ? refined(std::move(changed), 4 * changed.faces()) : indexed(simplified(changed, {.faces = 40}).mesh);
        const SkinPaint values = taken_off(changed, true, true);
        EXPECT_TRUE(changed.uvs.empty() && changed.colours.empty());
        ASSERT_EQ(values.painted.size(), changed.positions.size());
        for (std::size_t v = 0; v < changed.positions.size(); ++v) {
            const Vec3f p = changed.positions[v];
            EXPECT_EQ(values.painted[v].weighted, Vec3f(p.x, 0, p.z));
            EXPECT_EQ(values.painted[v].weight, p.x);
            EXPECT_EQ(values.lengths[v], 1 - p.x);
        }
    }
    // Nothing to carry: what the mesh has stays on it.
    Mesh same = carrying(mesh, {}, {});
    EXPECT_EQ(same.uvs, mesh.uvs);
    EXPECT_TRUE(taken_off(same, false, false).painted.empty());
    EXPECT_EQ(same.uvs, mesh.uvs);
}

}  // namespace
}  // namespace relievo
