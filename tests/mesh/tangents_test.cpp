#include "mesh/tangents.h"

#include "mesh/normals.h"
#include "mesh/shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relievo {
namespace {

Vec3f direction(const Vec4f& t) { return {t.x, t.y, t.z}; }

// A sheet whose texture coordinates are its positions through a matrix.
Mesh sheet(float uu, float uv, float vu, float vv) {
    Mesh mesh = test::grid(3);
    mesh.normals.assign(mesh.positions.size(), Vec3f(0, 0, 1));
    for (const Vec3f& p : mesh.positions) mesh.uvs.emplace_back(uu * p.x + uv * p.y, vu * p.x + vv * p.y);
    return mesh;
}

TEST(Tangents, PointAlongU) {
    for (const float angle : {0.0f, 0.7f, 2.5f}) {
        const float c = std::cos(angle), s = std::sin(angle);
        const TangentMesh t = with_tangents(sheet(c, s, -s, c));
        EXPECT_EQ(t.mesh.positions.size(), 16u);
        for (const Vec4f& v : t.tangents) {
            EXPECT_LT(length(direction(v) - Vec3f(c, s, 0)), 1e-6);
            EXPECT_EQ(v.w, 1.0f);
        }
    }
}

TEST(Tangents, MirroredTexturesHaveTheOtherSign) {
    for (const Vec4f& v : with_tangents(sheet(-1, 0, 0, 1)).tangents) {
        EXPECT_LT(length(direction(v) - Vec3f(-1, 0, 0)), 1e-6);
        EXPECT_EQ(v.w, -1.0f);
    }
}

// Texture mirrored at x = 1.5, as on the middle of a face: vertices on the line serve both sides and are doubled.
TEST(Tangents, MirrorLinesAreSplit) {
    Mesh mesh = test::grid(2);
    mesh.normals.assign(9, Vec3f(0, 0, 1));
    for (const Vec3f& p : mesh.positions) mesh.uvs.emplace_back(std::abs(p.x - 1), p.y);
    const TangentMesh t = with_tangents(mesh);
    EXPECT_EQ(t.mesh.positions.size(), 12u);
    EXPECT_EQ(test::face_set(t.mesh), test::face_set(mesh));
    for (std::size_t i = 0; i < t.mesh.indices.size(); ++i) {
        const Vec4f v = t.tangents[t.mesh.indices[i]];
        float middle = 0;
        for (std::size_t k = 0; k < 3; ++k) middle += t.mesh.positions[t.mesh.indices[i / 3 * 3 + k]].x / 3;
        EXPECT_LT(length(direction(v) - Vec3f(middle < 1 ? -1.0f : 1.0f, 0, 0)), 1e-6);
        EXPECT_EQ(v.w, middle < 1 ? -1.0f : 1.0f);
    }
}

TEST(Tangents, OnATorusRunAround) {
    Mesh mesh = test::torus(64, 32);
    mesh.normals = continuous_normals(mesh, NormalMode::angle);
    mesh = test::as_list(mesh);
    // Texture coordinates per corner, so that no face runs over the seam.
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const std::uint32_t square = static_cast<std::uint32_t>(f / 2), i = square / 32, j = square % 32;
        const Vec2f low(static_cast<float>(i), static_cast<float>(j));
        const Vec2f corners[2][3] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
        for (const Vec2f& c : corners[f % 2]) mesh.uvs.push_back(low + c);
    }
    const TangentMesh t = with_tangents(mesh);
    for (std::size_t v = 0; v < t.mesh.positions.size(); ++v) {
        const Vec3f p = t.mesh.positions[v], around = normalize(Vec3f(-p.y, p.x, 0));
        EXPECT_GT(dot(direction(t.tangents[v]), around), 0.99f);
        EXPECT_NEAR(dot(direction(t.tangents[v]), t.mesh.normals[v]), 0, 1e-5);
        EXPECT_NEAR(length(direction(t.tangents[v])), 1, 1e-5);
        EXPECT_EQ(t.tangents[v].w, 1.0f);
    }
}

TEST(Tangents, WithoutATextureAreStillAFrame) {
    Mesh mesh = test::sphere(2);
    mesh.normals = continuous_normals(mesh, NormalMode::angle);
    mesh.uvs.assign(mesh.positions.size(), Vec2f(0.5f, 0.5f));
    mesh.positions.emplace_back(5.0f, 5.0f, 5.0f);
    mesh.normals.emplace_back(0.0f, 0.0f, 0.0f);
    mesh.uvs.emplace_back(0.0f, 0.0f);
    const TangentMesh t = with_tangents(mesh);
    for (std::size_t v = 0; v < t.tangents.size(); ++v) {
        EXPECT_NEAR(length(direction(t.tangents[v])), 1, 1e-5);
        EXPECT_NEAR(dot(direction(t.tangents[v]), t.mesh.normals[v]), 0, 1e-5);
    }
}

}  // namespace
}  // namespace relievo
