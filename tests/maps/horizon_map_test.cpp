// The horizon map against geometry that can be written down, then against the walk of the reference, which shares no code with it.
#include "maps/horizon_map.h"

#include "core/error.h"
#include "maps/fields.h"
#include "reference/area_light.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

double degrees(double slope) { return std::atan(0.1 * slope) * 180 / std::numbers::pi; }  // as the map's code counts them

// Slopes below this are not looked for: the walk would be long, and no light stands so low (0.3 degrees).
constexpr double least_slope = 0.05;

// The slope by the reference's walk from a texel's centre, or least_slope. The cell is the one ahead.
double walked(const HeightField& field, int i, int j, int direction) {
    const Vec2i step = horizon_step(direction);
    const Vec2d uv_step{static_cast<double>(step.x) / field.width(), static_cast<double>(step.y) / field.height()};
    const ReferenceHit point{.found = true,
                             .uv = {(i + 0.5) / field.width(), (j + 0.5) / field.height()},
                             .height = field.texels(i, j),
                             .cell = {step.x < 0 ? i - 1 : i, step.y < 0 ? j - 1 : j}};
    return reference_horizon(field, point, uv_step / length(uv_step), least_slope, 1e12);
}

TEST(HorizonMap, stepsGoRoundTheSquare) {
    for (int d = 0; d < horizon_directions; ++d) {
        const Vec2i a = horizon_step(d);
        const Vec2i b = horizon_step((d + 1) % horizon_directions);
        EXPECT_EQ(std::max(std::abs(a.x), std::abs(a.y)), 4);
        EXPECT_GT(a.x * b.y - a.y * b.x, 0) << d << ": counter-clockwise";
        EXPECT_LE(std::abs(a.x - b.x) + std::abs(a.y - b.y), 1) << d << ": evenly spaced on the square";
    }
}

TEST(HorizonMap, flatFieldHasNone) {
    for (const float level : {0.0f, 0.7f, 1.0f}) {
        const ImageF map = horizon_map(HeightField(7, 5, level));
        ASSERT_EQ(map.channels, horizon_directions);
        for (const float code : map.texels) ASSERT_EQ(code, 0.0f);
    }
}

// A ridge along v: its rise over the distance to it, toward +u and toward -u, round the repeat; nothing along it.
TEST(HorizonMap, ridgeIsSeenAtItsRiseOverItsDistance) {
    HeightField field(32, 8, 0.25f);
    for (int j = 0; j < 8; ++j) field.texels(20, j) = 0.75f;
    const ImageF map = horizon_map(field);
    for (int i = 0; i < 32; ++i) {
        if (i == 20) continue;
        const double ahead = ((20 - i) + 32) % 32 / 32.0;
        EXPECT_NEAR(horizon_slope(map(i, 3, 0)), 0.5 / ahead, 1e-3) << i;
        EXPECT_NEAR(horizon_slope(map(i, 3, 16)), 0.5 / (1 - ahead), 1e-3) << i;
        EXPECT_EQ(map(i, 3, 8), 0.0f);
        // Along (4,4) the way is longer by what the step gains in v.
        EXPECT_NEAR(horizon_slope(map(i, 3, 4)), 0.5 / (ahead * 32 * std::hypot(1 / 32.0, 1 / 8.0)), 1e-2) << i;
    }
    for (int d = 0; d < horizon_directions; ++d) EXPECT_EQ(map(20, 3, d), 0.0f) << "nothing rises above the ridge";
}

// Never below the surface's horizon, and above it by no more than a bulge of a 64th of a cell's twist explains.
TEST(HorizonMap, isTheWalksHorizonOrALittleAbove) {
    constexpr int sizes[][2] = {{1, 1}, {1, 9}, {2, 2}, {16, 16}, {24, 9}, {31, 17}, {64, 32}};
    double most_above = 0;
    for (const auto& s : sizes)
        for (const HeightField& field : {test::random_field(s[0], s[1], 5), test::terraced_field(s[0], s[1], 6), test::smooth_field(s[0], s[1], 7),
                                         test::spike_field(s[0], s[1], s[0] / 3, s[1] / 2)}) {
            const ImageF map = horizon_map(field);
            for (int j = 0; j < s[1]; ++j)
                for (int i = 0; i < s[0]; ++i)
                    for (int d = 0; d < horizon_directions; ++d) {
                        const double truth = degrees(walked(field, i, j, d));
                        const double baked = map(i, j, d) * 90.0;
                        ASSERT_GE(baked, truth > degrees(least_slope) ? truth - 2e-5 : 0.0)
                            << s[0] << 'x' << s[1] << " at " << i << ' ' << j << " toward " << d;
                        most_above = std::max(most_above, baked - truth);
                    }
        }
    EXPECT_LT(most_above, 3.0) << "degrees; noise of independent texels is the worst field there is";
    EXPECT_GT(most_above, 0.1) << "the bound above would be idle";
}

TEST(HorizonMap, doesNotDependOnThreads) {
    const HeightField field = test::random_field(61, 45, 3);
    const ImageF one = horizon_map(field, 1);
    EXPECT_EQ(one.texels, horizon_map(field, 3).texels);
    EXPECT_EQ(one.texels, horizon_map(field, 16).texels);
}

TEST(HorizonMap, moving_the_field_moves_the_map) {
    const HeightField field = test::random_field(24, 20, 8);
    HeightField moved(24, 20);
    for (int j = 0; j < 20; ++j)
        for (int i = 0; i < 24; ++i) moved.texels(i, j) = field.wrapped(i + 7, j - 3);
    const ImageF a = horizon_map(field);
    const ImageF b = horizon_map(moved);
    for (int j = 0; j < 20; ++j)
        for (int i = 0; i < 24; ++i)
            for (int d = 0; d < horizon_directions; ++d)
                ASSERT_NEAR(b(i, j, d), a(wrap_index(i + 7, 24), wrap_index(j - 3, 20), d), 1e-6f);
}

TEST(HorizonMap, canBeCancelled) {
    EXPECT_THROW(horizon_map(test::random_field(64, 64, 1), 1, [](std::string_view, double) { throw Cancelled(); }), Cancelled);
}

}  // namespace
}  // namespace relievo
