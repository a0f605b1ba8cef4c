#include "maps/height_from_normal.h"

#include "core/error.h"
#include "maps/fields.h"
#include "maps/normal_map.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace relievo {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

// z = a sin(2 pi (3u + v)): exact slopes give the exact surface, at any size.
TEST(HeightFromNormal, WaveComesBackExactly) {
    constexpr int sizes[][2] = {{32, 32}, {37, 24}, {30, 41}, {64, 9}};
    const double a = 0.02;
    for (const auto& size : sizes) {
        const int w = size[0];
        const int h = size[1];
        ImageF normals(w, h, 3);
        for (int j = 0; j < h; ++j)
            for (int i = 0; i < w; ++i) {
                const double slope = a * two_pi * std::cos(two_pi * (3 * (i + 0.5) / w + (j + 0.5) / h));
                const Vec3d n = normalize(Vec3d{-3 * slope, -slope, 1});
                normals(i, j, 0) = static_cast<float>(n.x);
                normals(i, j, 1) = static_cast<float>(n.y);
                normals(i, j, 2) = static_cast<float>(n.z);
            }
        const IntegratedHeight got = height_from_normal(normals);
        EXPECT_NEAR(got.height_scale, 2 * a, 0.02 * a) << w << 'x' << h;
        EXPECT_LT(got.inconsistency, 1e-4);
        EXPECT_NEAR(got.mean_slope.x, 0, 1e-5);
        const double offset = got.height_scale * got.height.texels(0, 0) - a * std::sin(two_pi * (1.5 / w + 0.5 / h));
        for (int j = 0; j < h; ++j)
            for (int i = 0; i < w; ++i)
                ASSERT_NEAR(got.height_scale * got.height.texels(i, j) - offset, a * std::sin(two_pi * (3 * (i + 0.5) / w + (j + 0.5) / h)), 1e-6);
    }
}

TEST(HeightFromNormal, IntegratesTheNormalsOfAKnownFieldBack) {
    for (const int size : {64, 75}) {
        HeightField field = test::smooth_field(size, size, 6);
        const auto [low, high] = std::ranges::minmax(field.texels.texels);
        for (float& h : field.texels.texels) h = (h - low) / (high - low);
        const IntegratedHeight got = height_from_normal(normal_map(field, 0.07f));
        // normal_map's central differences see a wave of k periods weaker by sin(x)/x, x = 2 pi k / size: 2.6 % at k = 4 of 64.
        EXPECT_NEAR(got.height_scale, 0.07, 0.07 * 0.02);
        for (std::size_t k = 0; k < field.texels.texels.size(); ++k)
            ASSERT_NEAR(got.height.texels.texels[k], field.texels.texels[k], 0.02);
    }
}

TEST(HeightFromNormal, FlatNormalsHaveNoRelief) {
    const IntegratedHeight got = height_from_normal(normal_map(HeightField(12, 7, 0.4f), 0.1f));
    EXPECT_EQ(got.height_scale, 0.0f);
    for (const float h : got.height.texels.texels) EXPECT_EQ(h, 1.0f);
    EXPECT_EQ(height_from_normal(normal_map(HeightField(1, 1), 0.1f)).height.texels(0, 0), 1.0f);
}

// A plane's slope cannot repeat: it is reported, not integrated into a sawtooth.
TEST(HeightFromNormal, MeanSlopeIsTakenOutAndReported) {
    ImageF normals(16, 16, 3);
    for (std::size_t k = 0; k < normals.texels.size(); k += 3) {
        const Vec3f n = normalize(Vec3f{-0.25f, 0.5f, 1});
        normals.texels[k] = n.x;
        normals.texels[k + 1] = n.y;
        normals.texels[k + 2] = n.z;
    }
    const IntegratedHeight got = height_from_normal(normals);
    EXPECT_NEAR(got.mean_slope.x, 0.25, 1e-5);
    EXPECT_NEAR(got.mean_slope.y, -0.5, 1e-5);
    EXPECT_LT(got.height_scale, 1e-6);
}

// A flipped green channel is no longer the gradient of anything.
TEST(HeightFromNormal, FlippedGreenShowsAsInconsistency) {
    ImageF normals = normal_map(test::smooth_field(64, 64, 2), 0.1f);
    const float right = height_from_normal(normals).inconsistency;
    for (std::size_t k = 1; k < normals.texels.size(); k += 3) normals.texels[k] = -normals.texels[k];
    EXPECT_LT(right, 0.05f);
    EXPECT_GT(height_from_normal(normals).inconsistency, 5 * right);
}

TEST(HeightFromNormal, BackwardAndZeroNormalsStayFinite) {
    ImageF normals(9, 9, 3, 0.0f);
    normals(2, 2, 0) = 1;
    normals(5, 5, 1) = 0.5f;
    normals(5, 5, 2) = -0.5f;
    for (const float h : height_from_normal(normals).height.texels.texels) {
        EXPECT_TRUE(h >= 0 && h <= 1);
    }
}

TEST(HeightFromNormal, DoesNotDependOnThreadsAndCanBeCancelled) {
    const ImageF normals = normal_map(test::random_field(50, 66, 4), 0.1f);
    EXPECT_EQ(height_from_normal(normals, 1).height.texels.texels, height_from_normal(normals, 3).height.texels.texels);
    EXPECT_THROW(height_from_normal(normals, 2, [](std::string_view, double) { throw Cancelled(); }), Cancelled);
}

}  // namespace
}  // namespace relievo
