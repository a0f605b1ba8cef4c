// Exact hard shadows against geometry that can be written down, then against brute force.
#include "reference/cast.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

using namespace relievo;

namespace {

ReferenceHit point_on(const HeightField& field, Vec2d uv) { return reference_cast(field, {.uv = uv, .uv_per_height = {0, 0}}); }

}  // namespace

TEST(reference_shadow, flat_ground_is_lit_from_above_and_hidden_from_below) {
    const HeightField field(8, 8, 0.3f);
    const ReferenceHit point = point_on(field, {0.37, 0.81});
    for (const double z : {1e-3, 0.5, 1.0}) EXPECT_FALSE(reference_shadow(field, point, normalize(Vec3d{0.6, -0.8, z}), 0.1));
    for (const double z : {0.0, -1e-12, -1.0}) EXPECT_TRUE(reference_shadow(field, point, normalize(Vec3d{0.6, -0.8, z}), 0.1));
    EXPECT_FALSE(reference_shadow(field, point, {0, 0, 1}, 0.1));
    EXPECT_FALSE(reference_shadow(HeightField(4, 4, 1.0f), point_on(HeightField(4, 4, 1.0f), {0.2, 0.2}), {0.6, 0, 0.8}, 0.1));
}

// A wall of height H throws a shadow of length H height_scale / tan(elevation).
TEST(reference_shadow, a_wall_throws_a_shadow_of_its_length) {
    const int n = 256;
    const double scale = 0.1;
    for (const double elevation_deg : {15.0, 30.0, 60.0}) {
        for (const bool along_u : {true, false}) {
            for (const int sign : {1, -1}) {
                const double top = 0.75;
                HeightField field(n, n);
                for (int k = 0; k < n; ++k) field.texels(along_u ? 128 : k, along_u ? k : 128) = static_cast<float>(top);
                const double e = elevation_deg * std::numbers::pi / 180;
                const double ridge = 128.5 / n;
                const double length_uv = top * scale / std::tan(e);
                ASSERT_GT(length_uv, 1.0 / n);
                const Vec3d light = along_u ? Vec3d{sign * std::cos(e), 0, std::sin(e)} : Vec3d{0, sign * std::cos(e), std::sin(e)};
                for (const double off : {-1e-9, 1e-9}) {
                    const double at = ridge - sign * (length_uv + off);
                    const Vec2d uv = along_u ? Vec2d{at, 0.4321} : Vec2d{0.4321, at};
                    EXPECT_EQ(reference_shadow(field, point_on(field, uv), light, scale), off < 0) << elevation_deg << " " << off;
                }
            }
        }
    }
}

TEST(reference_shadow, a_slope_hides_itself_exactly_where_it_turns_away) {
    // One sheer flank rising to the right, from 0 at texel 3 to 1 at texel 4 of 8: slope dh/du = 8, so the light from the right
    // grazes it when height_scale / tan(elevation) * 8 = 1.
    HeightField field(8, 1);
    for (int i = 4; i < 8; ++i) field.texels(i, 0) = 1;
    const double scale = 0.1;
    const double grazing = std::atan(scale * 8);
    for (const double u : {3.5001 / 8, 4.0 / 8, 4.4999 / 8}) {
        const ReferenceHit point = point_on(field, {u, 0.2});
        for (const double off : {-1e-9, 1e-9}) {
            const double e = grazing + off;
            EXPECT_EQ(reference_shadow(field, point, {std::cos(e), 0, std::sin(e)}, scale), off < 0) << u << " " << off;
        }
        EXPECT_FALSE(reference_shadow(field, point, {-std::cos(0.3), 0, std::sin(0.3)}, scale));
    }
}

// Points exactly on creases and texel centres, where the known root lies on a wall: no acne, no leak.
TEST(reference_shadow, creases_are_judged_like_any_point) {
    const int n = 16;
    HeightField ridge(n, n);
    HeightField valley(n, n);
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const float fall = 1.0f - std::abs(i - 8) / 8.0f;  // a roof with its ridge at texel 8
            ridge.texels(i, j) = fall;
            valley.texels(i, j) = 1 - fall;
        }
    }
    const double scale = 0.5;
    for (const double e_deg : {5.0, 20.0, 44.0, 46.0, 80.0}) {
        const double e = e_deg * std::numbers::pi / 180;
        // The roof's slope: a height of 1 over half a period, times scale: 1. It lies at 45 degrees.
        for (const int sign : {1, -1}) {
            const Vec3d light{sign * std::cos(e), 0, std::sin(e)};
            for (int j = 0; j < n; ++j) {
                const double v = (j + 0.5) / n;
                EXPECT_FALSE(reference_shadow(ridge, point_on(ridge, {8.5 / n, v}), light, scale)) << "ridge at " << e_deg;
                EXPECT_EQ(reference_shadow(valley, point_on(valley, {8.5 / n, v}), light, scale), e_deg < 45) << "valley at " << e_deg;
            }
        }
    }
}

// The same where nothing is a round number and the crease runs up and down: the hit's own rounding must not decide.
TEST(reference_shadow, creases_hit_aslant_are_judged_like_any_point) {
    const int n = 11;
    HeightField ridge(n, n);
    HeightField valley(n, n);
    const auto from_4 = [&](int i) { return std::min(std::abs(i - 4), n - std::abs(i - 4)) / 6.0; };
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            valley.texels(i, j) = static_cast<float>(0.5 * from_4(i) + 0.4 * from_4(j));
            ridge.texels(i, j) = 1 - valley.texels(i, j);
        }
    }
    std::mt19937 random(13);
    std::uniform_real_distribution<double> uniform(0, 1);
    const double scale = 0.3;
    const double flank = std::atan(scale * 0.5 * n / 6);  // its angle across the crease
    for (int k = 0; k < 5000; ++k) {
        const Vec2d uv{4.5 / n, 3 * uniform(random)};
        const double e = flank * (uniform(random) < 0.5 ? 0.9 : 1.1);
        const Vec3d light{uniform(random) < 0.5 ? std::cos(e) : -std::cos(e), 0, std::sin(e)};
        for (const HeightField* field : {&ridge, &valley}) {
            // On the ridge a light lower than the flank reaches only one side, and the side is what rounding does decide.
            if (field == &ridge && e < flank) continue;
            // A slanted ray that meets the crease at uv.
            const Vec2d r{0.2 * uniform(random) - 0.1, 0.2 * uniform(random) - 0.1};
            const double h = field->sample(uv);
            const ReferenceHit point = reference_cast(*field, {.uv = uv + (1 - h) * r, .uv_per_height = r});
            ASSERT_NEAR(point.height, h, 1e-12);
            EXPECT_EQ(reference_shadow(*field, point, light, scale), field == &valley && e < flank) << k;
        }
    }
}

// A twisted patch sags along one diagonal: its far corner hides its own near flank.
TEST(reference_shadow, the_second_root_of_the_own_cell_hides) {
    // 2x2 field, cell (0,0) with corners 1 at (0,0) and (1,1), 0 else: h = 1 - x - y + 2 x y, a saddle. Along the diagonal x = y = p:
    // h = 1 - 2p + 2p^2. From p = 1/4 (h = 5/8) the chord to p = 1 (h = 1) has slope (3/8)/(3/4) = 1/2 per p; a line with less
    // rise than that meets the patch again inside the cell, one with more leaves it.
    HeightField field(2, 2);
    field.texels(0, 0) = field.texels(1, 1) = 1;
    const ReferenceHit point = point_on(field, {0.75 / 2, 0.75 / 2});
    ASSERT_DOUBLE_EQ(point.height, 0.625);
    ASSERT_EQ(point.cell, (Vec2i{0, 0}));
    const double scale = 0.25;
    for (const double off : {-1e-9, 1e-9}) {
        const double rise = 0.5 + off;  // height per p; p is 1/2 UV along each axis
        const Vec3d light = normalize(Vec3d{0.5, 0.5, rise * scale});
        EXPECT_EQ(reference_shadow(field, point, light, scale), off < 0) << off;
    }
}

// The verdict against a thousand points per texel along the light ray; undecided within 1e-6 of touching.
TEST(reference_shadow, agrees_with_brute_force) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(0, 1);
    int decided = 0;
    int hidden_count = 0;
    HeightField field(12, 9);
    for (float& h : field.texels.texels) h = static_cast<float>(uniform(random));
    for (int k = 0; k < 2000; ++k) {
        const double scale = 0.05 + 0.3 * uniform(random);
        const ReferenceHit point = reference_cast(
            field, {.uv = {uniform(random) * 4 - 2, uniform(random)}, .uv_per_height = {uniform(random) - 0.5, uniform(random) - 0.5}});
        const double a = 2 * std::numbers::pi * uniform(random);
        const double e = 0.05 + 1.4 * uniform(random);
        const Vec3d light{std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
        const Vec2d speed = Vec2d{light.x, light.y} * (scale / light.z);
        const double texels = length(speed) * 12 * (1 - point.height);
        const int samples = 10 + static_cast<int>(1000 * texels);
        double deepest = -1;
        for (int s = 1; s <= samples; ++s) {
            const double t = (1 - point.height) * s / samples;
            deepest = std::max(deepest, field.sample(point.uv + speed * t) - point.height - t);
        }
        const bool hidden = reference_shadow(field, point, light, scale);
        EXPECT_TRUE(hidden || deepest <= 1e-9) << k;
        // Between samples the field may rise above the line by the patch's bend over a thousandth of a cell at most.
        EXPECT_TRUE(!hidden || deepest > -2e-3) << k;
        decided += deepest > 1e-9 || !hidden;
        hidden_count += hidden;
    }
    EXPECT_GT(decided, 1950);
    EXPECT_GT(hidden_count, 300);
    EXPECT_LT(hidden_count, 1700);
}
