#include "maps/normal_map.h"

#include "core/vec.h"
#include "maps/fields.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

Vec3f normal_at(const ImageF& normals, int i, int j) { return {normals(i, j, 0), normals(i, j, 1), normals(i, j, 2)}; }

TEST(NormalMap, FlatFieldLooksUp) {
    for (const int n : {1, 2, 5}) {
        const ImageF normals = normal_map(HeightField(n, n, 0.7f), 0.1f);
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) EXPECT_EQ(normal_at(normals, i, j), (Vec3f{0, 0, 1}));
    }
}

// h = u in a field of 16 x 4: the slope of the raised surface is the height_scale itself, except at the two texels of the step.
TEST(NormalMap, RampHasItsAnalyticSlope) {
    HeightField ramp(16, 4);
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 16; ++i) ramp.texels(i, j) = (static_cast<float>(i) + 0.5f) / 16.0f;
    const ImageF normals = normal_map(ramp, 0.5f);
    const Vec3f expected = normalize(Vec3f{-0.5f, 0, 1});
    for (int i = 1; i < 15; ++i) {
        const Vec3f n = normal_at(normals, i, 2);
        EXPECT_NEAR(n.x, expected.x, 1e-6);
        EXPECT_EQ(n.y, 0.0f);
        EXPECT_NEAR(n.z, expected.z, 1e-6);
    }
    // At the seam the central difference spans 14/16 downward over two texels.
    const Vec3f seam = normalize(Vec3f{0.5f * 0.875f * 8.0f, 0, 1});
    EXPECT_NEAR(normal_at(normals, 0, 1).x, seam.x, 1e-6);
}

TEST(NormalMap, RisingAlongVLeansAgainstV) {
    HeightField ramp(4, 16);
    for (int j = 0; j < 16; ++j)
        for (int i = 0; i < 4; ++i) ramp.texels(i, j) = (static_cast<float>(j) + 0.5f) / 16.0f;
    EXPECT_NEAR(normal_at(normal_map(ramp, 1.0f), 2, 8).y, -std::sqrt(0.5f), 1e-6);
}

// The declared rule: the mean of the gradients of the four bilinear patches that meet at the texel centre.
TEST(NormalMap, IsTheMeanGradientOfTheFourPatches) {
    const HeightField field = test::random_field(7, 5, 11);
    const ImageF normals = normal_map(field, 0.2f);
    const double e = 1e-6;
    for (int j = 0; j < 5; ++j)
        for (int i = 0; i < 7; ++i) {
            const Vec2d uv{(i + 0.5) / 7, (j + 0.5) / 5};
            const double du = (field.sample({uv.x + e, uv.y}) - field.sample({uv.x - e, uv.y})) / (2 * e);
            const double dv = (field.sample({uv.x, uv.y + e}) - field.sample({uv.x, uv.y - e})) / (2 * e);
            const Vec3d n = normalize(Vec3d{-0.2 * du, -0.2 * dv, 1});
            EXPECT_NEAR(normals(i, j, 0), n.x, 1e-5);
            EXPECT_NEAR(normals(i, j, 1), n.y, 1e-5);
            EXPECT_NEAR(normals(i, j, 2), n.z, 1e-5);
        }
}

TEST(NormalMap, DoesNotDependOnThreads) {
    const HeightField field = test::random_field(67, 129, 5);
    EXPECT_EQ(normal_map(field, 0.1f, 1).texels, normal_map(field, 0.1f, 4).texels);
}

}  // namespace
}  // namespace relievo
