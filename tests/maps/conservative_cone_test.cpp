#include "maps/conservative_cone.h"

#include "core/error.h"
#include "maps/cone_map.h"
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

TEST(ConservativeCone, LevelFieldIsWideOpen) {
    for (const float level : {0.0f, 0.3f, 1.0f})
        for (const auto& [w, h] : {std::pair{1, 1}, {9, 4}, {2, 1}}) {
            const ImageF cones = conservative_cone(HeightField(w, h, level));
            for (int y = 0; y < h; ++y)
                for (int x = 0; x < w; ++x) {
                    EXPECT_EQ(cones(x, y, 0), level);
                    EXPECT_EQ(cones(x, y, 1), 1.0f);
                }
        }
}

// A wall from 0 at texel column 7 to 0.5 at column 8, back down from 15 to 0: seen from column x, the steepest point of its ramp is
// the ramp's top, at 8 - x texels; between texels nothing is steeper, because the ramp is a plane through lower ground.
TEST(ConservativeCone, StepIsLimitedByTheTopOfItsRamp) {
    HeightField step(16, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 8; x < 16; ++x) step.texels(x, y) = 0.5f;
    const ImageF cones = conservative_cone(step);
    for (int x = 0; x < 8; ++x) expect_ratio(cones, x, 1, std::min(x + 1, 8 - x) / 16.0 / 0.5);
    for (int x = 8; x < 16; ++x) EXPECT_EQ(cones(x, 1, 1), 1.0f);
}

// A slope of 1 exactly, all along an edge: the cone would touch it everywhere, and is lowered like any other.
TEST(ConservativeCone, SlopeOfOneIsLoweredToo) {
    HeightField ramp(16, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 16; ++x) ramp.texels(x, y) = static_cast<float>(std::min(x, 16 - x)) / 16;
    const ImageF cones = conservative_cone(ramp);
    for (int x = 1; x < 8; ++x) {
        EXPECT_LT(cones(x, 1, 1), 1.0f);
        EXPECT_GE(cones(x, 1, 1), 1 - lowered);
    }
    EXPECT_EQ(cones(8, 1, 1), 1.0f);
}

// Two corners at height 1 across a cell: beside texel (4, 4) the surface rises by (1, 1) per texel, steeper than along its edges.
TEST(ConservativeCone, GradientAtTheTexelItselfBinds) {
    constexpr int n = 16;
    HeightField saddle(n, n);
    saddle.texels(5, 4) = 1.0f;
    saddle.texels(4, 5) = 1.0f;
    expect_ratio(conservative_cone(saddle), 4, 4, 1 / (std::numbers::sqrt2 * n));
}

// A cell like the shoulder of a hill, seen along its diagonal from one cell before it. Along the diagonal, r texels away, the
// height is C + A r + B r^2 with C, B < 0, and the slope is largest at r = sqrt(C / B): A - 2 sqrt(C B), more than at the corners
// and edges.
TEST(ConservativeCone, ShoulderBindsInsideItsCell) {
    constexpr int n = 16;
    HeightField shoulder(n, n);
    shoulder.texels(4, 4) = 0.2645f;
    shoulder.texels(5, 4) = 0.4192f;
    shoulder.texels(4, 5) = 0.4192f;
    shoulder.texels(5, 5) = 0.473f;
    const double h00 = shoulder.texels(4, 4), h10 = shoulder.texels(5, 4), h11 = shoulder.texels(5, 5);
    const double twist = h11 - 2 * h10 + h00;
    const double gradient = h10 - h00 - twist;
    const double at_apex = h00 - 2 * (h10 - h00) + twist;
    const double slope = std::numbers::sqrt2 * gradient - std::sqrt(2 * at_apex * twist);
    // The edge from (4, 4) to (5, 4) by its own formula, and the corners.
    const double b = h10 - h00;
    const double a = h00 - b;
    ASSERT_GT(slope,
              1.0005 * std::max({std::sqrt(a * a + b * b), h00 / std::sqrt(2.0), h10 / std::sqrt(5.0), h11 / std::sqrt(8.0)}));
    expect_ratio(conservative_cone(shoulder), 3, 3, 1 / (slope * n));
}

// An edge across the view: heights 0.4 and 0.5 at (4, 0) and (4, 1) seen from (0, 0). With a = 0.4, b = 0.1, E = 4 the point
// y* = b E^2 / a = 4 lies beyond the edge; with heights 0.5 and 0.52 at E = 4, y* = 0.02 * 16 / 0.5 = 0.64 lies on it.
TEST(ConservativeCone, EdgeBindsBetweenItsEnds) {
    constexpr int n = 64;
    HeightField edge(n, n);
    edge.texels(4, 0) = 0.5f;
    edge.texels(4, 1) = 0.52f;
    const double a = 0.5f;
    const double b = 0.52f - 0.5f;
    expect_ratio(conservative_cone(edge), 0, 0, 4.0 / n / std::sqrt(a * a + b * b * 16));
    EXPECT_LT(conservative_cone(edge)(0, 0, 1), 0.9999f * cone_map(edge)(0, 0, 1));
}

// A cone of slope 2 around texel (16, 16): from its foot the ratio is 1/2 wherever the way up is a straight line of texels.
TEST(ConservativeCone, ConeShapedFieldHasItsOwnRatio) {
    constexpr int n = 64;
    HeightField cone(n, n);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            cone.texels(x, y) = static_cast<float>(std::max(0.0, 0.5 - 2 * std::hypot(x - 16.0, y - 16.0) / n));
    const ImageF cones = conservative_cone(cone);
    for (int x = 1; x < 16; ++x) EXPECT_NEAR(cones(x, 16, 1), 0.5 * std::max(16, 16 - x) / 16.0, 1e-3) << x;
    EXPECT_EQ(cones(16, 16, 1), 1.0f);
}

TEST(ConservativeCone, EqualsBruteForceOverTheSurface) {
    constexpr int sizes[][2] = {{1, 1}, {1, 2}, {2, 1}, {3, 3}, {1, 12}, {12, 1}, {7, 13}, {16, 16}, {17, 9}, {33, 5}};
    for (const auto& s : sizes)
        for (const HeightField& field : {test::random_field(s[0], s[1], 1), test::terraced_field(s[0], s[1], 2),
                                         test::smooth_field(s[0], s[1], 3), test::spike_field(s[0], s[1], s[0] / 3, s[1] / 2)}) {
            const ImageF cones = conservative_cone(field);
            for (int y = 0; y < s[1]; ++y)
                for (int x = 0; x < s[0]; ++x) {
                    const double truth = test::surface_ratio(field, x, y, {});
                    ASSERT_LE(cones(x, y, 1), truth * (1 + 1e-9)) << s[0] << 'x' << s[1] << " at " << x << ' ' << y;
                    ASSERT_GE(cones(x, y, 1), truth * (1 - 1e-4)) << s[0] << 'x' << s[1] << " at " << x << ' ' << y;
                }
        }
}

TEST(ConservativeCone, NeverWiderThanTheSampledCone) {
    for (const auto& [w, h] : {std::pair{65, 40}, {24, 96}}) {
        const HeightField field = test::smooth_field(w, h, 5);
        const ImageF ours = conservative_cone(field);
        const ImageF sampled = cone_map(field);
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) ASSERT_LE(ours(x, y, 1), sampled(x, y, 1));
    }
}

// A field and its shift by any whole texels have the same cones to the last bit: nothing is special at the seam, and the largest
// slope found does not depend on what was searched first.
TEST(ConservativeCone, SeamIsLikeAnyOtherPlace) {
    const int w = 30;
    const int h = 18;
    for (const HeightField& field : {test::random_field(w, h, 4), test::smooth_field(w, h, 4)}) {
        HeightField moved(w, h);
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) moved.texels(x, y) = field.wrapped(x + 13, y - 7);
        const ImageF a = conservative_cone(field);
        const ImageF b = conservative_cone(moved);
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) ASSERT_EQ(b(x, y, 1), a(wrap_index(x + 13, w), wrap_index(y - 7, h), 1)) << x << ' ' << y;
    }
}

TEST(ConservativeCone, DoesNotDependOnThreads) {
    const HeightField field = test::smooth_field(150, 90, 8);
    const ImageF one = conservative_cone(field, 1);
    EXPECT_EQ(one.texels, conservative_cone(field, 2).texels);
    EXPECT_EQ(one.texels, conservative_cone(field, 7).texels);
}

TEST(ConservativeCone, StopsWhenCancelled) {
    int calls = 0;
    EXPECT_THROW(conservative_cone(test::random_field(256, 256, 1), 2,
                                   [&](std::string_view, double) {
                                       if (++calls == 2) throw Cancelled();
                                   }),
                 Cancelled);
}

}  // namespace
}  // namespace relievo
