// Whether a hit is what was promised, on rays whose solids are given.
#include "measure/astray.h"
#include "measure/steepness.h"

#include <gtest/gtest.h>

#include <array>

namespace relievo {
namespace {

// A thin wall from 0.8 to 0.78, a thick one from 0.6 to 0.5, the ground from 0.2 down.
constexpr std::array<Solid, 3> walls{{{0.8f, 0.78f}, {0.6f, 0.5f}, {0.2f, 0.0f}}};
const AstrayRay ray{.solids = walls, .lowest = 0.75, .highest = 0.85, .zero_level = 1, .texels_per_height = 100, .rounding = 1e-6};

TEST(Astray, IsWhatIsNoCrossing) {
    const Promise exact{};
    EXPECT_FALSE(is_astray(ray, 0.8, exact));
    EXPECT_TRUE(is_astray(ray, 0.801, exact));
    EXPECT_TRUE(is_astray(ray, 0.799, exact));
    EXPECT_TRUE(is_astray(ray, 0.6, exact)) << "a second wall is not the first hit";
    const Promise near{.error = 0.01};
    EXPECT_FALSE(is_astray(ray, 0.809, near));
    EXPECT_FALSE(is_astray(ray, 0.791, near));
    EXPECT_TRUE(is_astray(ray, 0.789, near)) << "inside the wall is not on it";
}

TEST(Astray, AllowsToStepOverWhatIsThinner) {
    const Promise steps{.error = 0.001, .stride = 0.03};
    EXPECT_FALSE(is_astray(ray, 0.8, steps));
    EXPECT_FALSE(is_astray(ray, 0.6, steps)) << "a wall of 0.02 may be stepped over";
    EXPECT_TRUE(is_astray(ray, 0.2, steps)) << "one of 0.1 may not";
    EXPECT_TRUE(is_astray(ray, 0.7, steps)) << "between walls there is nothing";
    EXPECT_FALSE(is_astray(ray, 0.2, Promise{.error = 0.001, .stride = 1}));
}

TEST(Astray, CountsTexelsAlongTheRay) {
    const Promise texel{.texels = 1};  // 0.01 of height here
    EXPECT_FALSE(is_astray(ray, 0.809, texel));
    EXPECT_TRUE(is_astray(ray, 0.811, texel));
    EXPECT_TRUE(is_astray(ray, 0.6, texel)) << "the wall is two texels thick";
    EXPECT_FALSE(is_astray(ray, 0.6, Promise{.texels = 2.1}));
}

TEST(Astray, MeasuresShiftsByWhatLiesBetween) {
    EXPECT_FALSE(is_astray(ray, 0.71, Promise{.relief = 1})) << "heights differ by 0.1 on the way";
    EXPECT_TRUE(is_astray(ray, 0.69, Promise{.relief = 1}));
    EXPECT_FALSE(is_astray(ray, 0.95, Promise{.unmoved = 0.5, .relief = 0.5}));
    EXPECT_TRUE(is_astray(ray, 0.96, Promise{.unmoved = 0.5, .relief = 0.5}));
    EXPECT_FALSE(is_astray(ray, 1, Promise{.polygon = true}));
    EXPECT_TRUE(is_astray(ray, 1.01, Promise{.polygon = true})) << "farther than the polygon";
}

// Two pixels see level ground at height 0.5 through a polygon at 1; a third sees nothing.
TEST(Astray, IsAShareOfThePixelsThatSeeTheSurface) {
    RayField rays(3, 1);
    Frame picture(3, 1);
    RaySolids truth;
    for (int x = 0; x < 3; ++x) {
        rays.coverage(x, 0) = x < 2 ? 1 : 0;
        rays.view(x, 0, 0) = 0.6f, rays.view(x, 0, 2) = 0.8f;
        if (x < 2) truth.solids.push_back({0.5f, 0.0f});
        truth.rays.push_back({.first = static_cast<std::size_t>(x), .count = x < 2 ? 1u : 0u, .lowest = 0.5f, .highest = 0.5f});
    }
    // 0.1 * 0.6 / 0.8 = 0.075 UV per height.
    picture.coverage(0, 0) = picture.coverage(1, 0) = static_cast<std::uint8_t>(Coverage::hit);
    picture.hit_uv(0, 0, 0) = -0.0375f;
    picture.hit_uv(1, 0, 0) = -0.0300f;  // at height 0.6
    const auto share = [&](Promise promise) {
        return *astray_share(picture, rays, truth, {.texels = {64, 64}, .height_scale = 0.1, .zero_level = 1, .promise = [=](double) { return promise; }, .threads = 1});
    };
    EXPECT_EQ(share({}), 0.5);
    EXPECT_EQ(share({.error = 0.11}), 0.0);
    picture.coverage(1, 0) = static_cast<std::uint8_t>(Coverage::no_hit);
    EXPECT_EQ(share({.error = 0.11}), 0.5) << "nothing found is not what was promised";
    truth.rays[0].count = truth.rays[1].count = 0;
    EXPECT_FALSE(astray_share(picture, rays, truth, {.texels = {64, 64}, .height_scale = 0.1, .promise = [](double) { return Promise{}; }}));
}

TEST(Steepness, IsTheSlopeOfARoof) {
    HeightField roof(8, 4);
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 8; ++i) roof.texels(i, j) = static_cast<float>(i < 4 ? i : 8 - i) / 4;
    // Up by 1 and down by 1 over half a repeat each, everywhere.
    EXPECT_NEAR(rms_slope(roof, 0.1), 0.2, 1e-9);
    EXPECT_EQ(rms_slope(HeightField(3, 3, 0.5f), 0.1), 0);
}

}  // namespace
}  // namespace relievo
