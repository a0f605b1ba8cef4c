#include "maps/relaxed_cone.h"

#include "core/error.h"
#include "maps/conservative_cone.h"
#include "maps/fields.h"
#include "maps/surface_slopes.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

constexpr double lowered = 0x1p-19;  // what the definition allows for rounding

void expect_ratio(const ImageF& cones, int x, int y, double expected) {
    const double ratio = cones(x, y, 1);
    EXPECT_LE(ratio, expected * (1 + 1e-9)) << x << ' ' << y;
    EXPECT_GE(ratio, expected * (1 - lowered)) << x << ' ' << y;
}

TEST(RelaxedCone, LevelFieldIsWideOpen) {
    for (const float level : {0.0f, 0.3f, 1.0f})
        for (const auto& [w, h] : {std::pair{1, 1}, {9, 4}, {2, 1}}) {
            const ImageF cones = relaxed_cone(HeightField(w, h, level));
            for (const float& c : {cones(0, 0, 1), cones(w - 1, h - 1, 1)}) EXPECT_EQ(c, 1.0f);
        }
}

// A plateau of 0.5 from column 8 to 15: from column x one looks past its near edge, at x or at 16 - x texels, to the far edge,
// where it falls again. The cone enters the plateau's near wall and is limited by what is behind it.
TEST(RelaxedCone, PlateauIsLimitedByItsFarEdge) {
    constexpr int w = 32;
    HeightField step(w, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 8; x < 16; ++x) step.texels(x, y) = 0.5f;
    const ImageF relaxed = relaxed_cone(step);
    const ImageF conservative = conservative_cone(step);
    for (int x = 0; x < 8; ++x) {
        // To the right the plateau begins at 8 and falls from 15; to the left it begins at 15 - 32 and falls from 8 - 32.
        expect_ratio(relaxed, x, 1, std::min(1.0, std::min(15 - x, x - (8 - w)) / (0.5 * w)));
        expect_ratio(conservative, x, 1, std::min(1.0, std::min(8 - x, x - (15 - w)) / (0.5 * w)));
    }
    for (int x = 8; x < 16; ++x) EXPECT_EQ(relaxed(x, 1, 1), 1.0f);
}

// A ridge's crest limits both kinds alike: one way up, one way down.
TEST(RelaxedCone, CrestOfARidgeLimitsBothKinds) {
    constexpr int w = 32;
    HeightField ridge(w, 6);
    for (int y = 0; y < 6; ++y) {
        ridge.texels(15, y) = 0.25f;
        ridge.texels(16, y) = 0.8f;
        ridge.texels(17, y) = 0.25f;
    }
    const ImageF relaxed = relaxed_cone(ridge);
    for (int x = 0; x < 15; ++x)
        expect_ratio(relaxed, x, 2, std::min(16 - x, x - (16 - w)) / (0.8 * w) * (0.8 / static_cast<double>(0.8f)));
}

// A crest inside a cell, along a row: with a the height of both corners at X = 0, b the step of the near edge and -D the twist, the height is
// a + X (b + D) - D X Y, which falls outward beyond Y = (b + D) / 2D. Along that line it is a + X (b + D) / 2, and steepest where
// the slope is sqrt(a^2 / Y^2 + (b + D)^2 / 4), at X = Y^2 (b + D) / 2a. The arc of the crest begins at X = 0, where Y / X has no bound.
TEST(RelaxedCone, CrestAlongARowBindsInsideItsCell) {
    constexpr int n = 16;
    HeightField crest(n, n);
    crest.texels(4, 5) = 0.38f;
    crest.texels(4, 6) = 0.38f;
    crest.texels(3, 5) = 0.506f;
    crest.texels(3, 6) = 0.386f;
    const double a = crest.texels(4, 5);
    const double b = crest.texels(3, 5) - a;
    const double twist = b - (crest.texels(3, 6) - a);
    const double y = (b + twist) / (2 * twist);
    ASSERT_TRUE(y > 1 && y < 1.1);
    const double slope = std::hypot(a / y, (b + twist) / 2);
    ASSERT_GT(slope, 1.01 * a);
    expect_ratio(relaxed_cone(crest), 4, 4, 1 / (slope * n));
}

// The definition by its own words, on rays: from the axis of a cone, downward and outward, followed in small steps as far as the
// cone reaches; none may leave the solid in it. That the cone is also the widest is asked of brute force below.
TEST(RelaxedCone, NoRayFromTheAxisLeavesTheSolidInside) {
    std::mt19937 random(9);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
    int entered = 0;
    for (const HeightField& field :
         {test::smooth_field(40, 28, 3), test::random_field(12, 20, 4), test::terraced_field(16, 16, 5)}) {
        const ImageF cones = relaxed_cone(field);
        for (int n = 0; n < 3000; ++n) {
            const int x = static_cast<int>(uniform() * field.width());
            const int y = static_cast<int>(uniform() * field.height());
            const Vec2d uv{(x + 0.5) / field.width(), (y + 0.5) / field.height()};
            const double start = cones(x, y, 0) + (1.01 - cones(x, y, 0)) * uniform();
            const double angle = uniform() * 2 * std::numbers::pi;
            const double descent = std::exp(5 * uniform() - 3);  // heights per UV
            const double ratio = cones(x, y, 1);
            // start - descent r = height + r / ratio at the cone's wall.
            const double reach = (start - cones(x, y, 0)) / (descent + 1 / ratio);
            bool in = false;
            for (int k = 1; k < 400; ++k) {
                const double r = reach * k / 400;
                const double above = start - descent * r - field.sample({uv.x + r * std::cos(angle), uv.y + r * std::sin(angle)});
                ASSERT_FALSE(in && above > 1e-7) << "texel " << x << ' ' << y << ", ray from " << start << " by " << descent;
                entered += !in && above < 0;
                in = in || above < 0;
            }
        }
    }
    EXPECT_GT(entered, 200) << "most rays were no test";
}

TEST(RelaxedCone, EqualsBruteForceOverTheFallingSurface) {
    constexpr int sizes[][2] = {{1, 1}, {1, 2}, {2, 1}, {3, 3}, {1, 12}, {12, 1}, {7, 13}, {16, 16}, {17, 9}, {33, 5}};
    for (const auto& s : sizes)
        for (const HeightField& field : {test::random_field(s[0], s[1], 1), test::terraced_field(s[0], s[1], 2),
                                         test::smooth_field(s[0], s[1], 3), test::spike_field(s[0], s[1], s[0] / 3, s[1] / 2)}) {
            const ImageF cones = relaxed_cone(field);
            for (int y = 0; y < s[1]; ++y)
                for (int x = 0; x < s[0]; ++x) {
                    const double widest = test::surface_ratio(field, x, y, {.falling_only = true});
                    // What is level to a float's rounding may count as falling.
                    const double narrowest = test::surface_ratio(field, x, y, {.falling_only = true, .level = 0x1p-19});
                    ASSERT_LE(cones(x, y, 1), widest * (1 + 1e-9)) << s[0] << 'x' << s[1] << " at " << x << ' ' << y;
                    ASSERT_GE(cones(x, y, 1), narrowest * (1 - 3e-4)) << s[0] << 'x' << s[1] << " at " << x << ' ' << y;
                }
        }
}

// Plateaus many texels wide, whose level insides and convex corners fall nowhere: a cone is limited by their far rims alone.
TEST(RelaxedCone, PlateausLimitByTheirFarRims) {
    HeightField field = test::smooth_field(40, 24, 6);
    for (float& h : field.texels.texels) h = std::floor(h * 6) / 5;
    const ImageF cones = relaxed_cone(field);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 40; ++x) {
            ASSERT_LE(cones(x, y, 1), test::surface_ratio(field, x, y, {.falling_only = true, .lines = 8}) * (1 + 1e-9))
                << x << ' ' << y;
            ASSERT_GE(cones(x, y, 1),
                      test::surface_ratio(field, x, y, {.falling_only = true, .level = 0x1p-19, .lines = 8}) * (1 - 1e-3))
                << x << ' ' << y;
        }
}

TEST(RelaxedCone, NeverNarrowerThanTheConservativeCone) {
    const HeightField field = test::smooth_field(65, 40, 5);
    const ImageF relaxed = relaxed_cone(field);
    const ImageF conservative = conservative_cone(field);
    int wider = 0;
    for (int y = 0; y < 40; ++y)
        for (int x = 0; x < 65; ++x) {
            ASSERT_GE(relaxed(x, y, 1), conservative(x, y, 1) * (1 - lowered));
            wider += relaxed(x, y, 1) > 1.1f * conservative(x, y, 1);
        }
    EXPECT_GT(wider, 65 * 40 / 10);
}

TEST(RelaxedCone, SeamIsLikeAnyOtherPlace) {
    const int w = 30;
    const int h = 18;
    for (const HeightField& field : {test::random_field(w, h, 4), test::smooth_field(w, h, 4)}) {
        HeightField moved(w, h);
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) moved.texels(x, y) = field.wrapped(x + 13, y - 7);
        const ImageF a = relaxed_cone(field);
        const ImageF b = relaxed_cone(moved);
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) ASSERT_EQ(b(x, y, 1), a(wrap_index(x + 13, w), wrap_index(y - 7, h), 1)) << x << ' ' << y;
    }
}

TEST(RelaxedCone, DoesNotDependOnThreads) {
    const HeightField field = test::smooth_field(150, 90, 8);
    const ImageF one = relaxed_cone(field, 1);
    EXPECT_EQ(one.texels, relaxed_cone(field, 2).texels);
    EXPECT_EQ(one.texels, relaxed_cone(field, 7).texels);
}

TEST(RelaxedCone, StopsWhenCancelled) {
    int calls = 0;
    EXPECT_THROW(relaxed_cone(test::random_field(256, 256, 1), 2,
                              [&](std::string_view, double) {
                                  if (++calls == 2) throw Cancelled();
                              }),
                 Cancelled);
}

}  // namespace
}  // namespace relievo
