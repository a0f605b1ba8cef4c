// The share of a disc of light above the horizon: against a wall whose horizon can be written down, then against counted rays of the
// hard shadow.
#include "reference/area_light.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

using namespace relievo;

namespace {

ReferenceHit point_on(const HeightField& field, Vec2d uv) { return reference_cast(field, {.uv = uv, .uv_per_height = {0, 0}}); }

Vec3d direction(double azimuth, double elevation) {
    return {std::cos(azimuth) * std::cos(elevation), std::sin(azimuth) * std::cos(elevation), std::sin(elevation)};
}

HeightField noise(int width, int height, unsigned seed) {
    HeightField field(width, height);
    std::mt19937 random(seed);
    for (float& h : field.texels.texels) h = static_cast<float>(random() >> 8) * 0x1p-24f;
    return field;
}

constexpr double degree = std::numbers::pi / 180;

}  // namespace

TEST(reference_light_share, flat_ground_sees_all_of_a_light_above_the_plane_and_half_of_one_in_it) {
    const HeightField field(8, 8, 0.3f);
    const ReferenceHit point = point_on(field, {0.37, 0.81});
    EXPECT_DOUBLE_EQ(reference_light_share(field, point, direction(1, 30 * degree), 0.1, 5 * degree), 1);
    EXPECT_NEAR(reference_light_share(field, point, direction(1, 0), 0.1, 5 * degree), 0.5, 1e-2);
    EXPECT_EQ(reference_light_share(field, point, direction(1, -10 * degree), 0.1, 5 * degree), 0);
}

// A long wall straight ahead: the horizon falls with the cosine of the angle to its normal, nearly straight over a small disc, whose
// segment above a chord is (1/2 + (x sqrt(1 - x^2) + asin x) / pi).
TEST(reference_light_share, is_the_segment_of_the_disc_above_a_wall) {
    const int n = 512;
    HeightField field(n, 4);
    for (int j = 0; j < 4; ++j) field.texels(300, j) = 1;
    const double scale = 0.1;
    const double radius = 3 * degree;
    const double ridge = 300.5 / n;
    int between = 0;
    for (double away = 0.05; away < 0.4; away += 0.002) {
        const ReferenceHit point = point_on(field, {ridge - away, 0.3});
        const double horizon = std::atan(scale / away);
        const double x = std::clamp((30 * degree - horizon) / radius, -1.0, 1.0);
        const double expected = 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / std::numbers::pi;
        EXPECT_NEAR(reference_light_share(field, point, direction(0, 30 * degree), scale, radius, 256), expected, 5e-3) << away;
        between += expected > 0.01 && expected < 0.99;
    }
    EXPECT_GT(between, 5) << "the penumbra has to be in what was looked at";
}

// The same disc by counting: random points of the light, each by the exact hard shadow.
TEST(reference_light_share, agrees_with_counted_rays) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> unit(0, 1);
    double worst = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const HeightField field = noise(16 + trial % 3, 16, static_cast<unsigned>(trial));
        const double scale = 0.02 + 0.1 * unit(random);
        const double elevation = (10 + 60 * unit(random)) * degree;
        const double azimuth = 2 * std::numbers::pi * unit(random);
        const double radius = (1 + 8 * unit(random)) * degree;
        const ReferenceHit point = point_on(field, {unit(random) * 4 - 2, unit(random) * 4 - 2});
        const double share = reference_light_share(field, point, direction(azimuth, elevation), scale, radius, 64);
        int seen = 0;
        const int rays = 4000;
        for (int k = 0; k < rays; ++k) {
            const double r = std::sqrt(unit(random));
            const double turn = 2 * std::numbers::pi * unit(random);
            const Vec3d d = direction(azimuth + radius * r * std::cos(turn) / std::cos(elevation), elevation + radius * r * std::sin(turn));
            seen += !reference_shadow(field, point, d, scale);
        }
        const double counted = static_cast<double>(seen) / rays;
        // Four standard deviations of the counting, and what 64 slices leave.
        EXPECT_NEAR(share, counted, 4 * std::sqrt(0.25 / rays) + 0.01) << trial;
        worst = std::max(worst, std::abs(share - counted));
    }
    EXPECT_GT(worst, 0) << "some point has to lie in penumbra";
}

TEST(reference_light_share, sixteen_slices_are_enough) {
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(0, 1);
    double sum = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const HeightField field = noise(16, 16, static_cast<unsigned>(trial / 8));
        const ReferenceHit point = point_on(field, {unit(random), unit(random)});
        const Vec3d light = direction(2 * std::numbers::pi * unit(random), (20 + 30 * unit(random)) * degree);
        sum += std::abs(reference_light_share(field, point, light, 0.05, 3 * degree) - reference_light_share(field, point, light, 0.05, 3 * degree, 512));
    }
    EXPECT_LT(sum / 400, 0.004);
}

// A vanishing disc is the point light of the hard shadow.
TEST(reference_light_share, a_small_disc_is_the_hard_shadow) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> unit(0, 1);
    int hidden = 0;
    for (int trial = 0; trial < 500; ++trial) {
        const HeightField field = noise(12, 12, static_cast<unsigned>(trial / 10));
        const ReferenceHit point = point_on(field, {unit(random), unit(random)});
        const Vec3d light = direction(2 * std::numbers::pi * unit(random), (5 + 40 * unit(random)) * degree);
        const bool dark = reference_shadow(field, point, light, 0.05);
        EXPECT_NEAR(reference_light_share(field, point, light, 0.05, 1e-7), dark ? 0 : 1, 1e-5) << trial;
        hidden += dark;
    }
    EXPECT_GT(hidden, 20);
    EXPECT_LT(hidden, 480);
}
