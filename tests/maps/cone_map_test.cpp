#include "maps/cone_map.h"

#include "core/error.h"
#include "maps/fields.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace relievo {
namespace {

// The definition in cone_map.h, texel against texel.
ImageF by_definition(const HeightField& field) {
    const int w = field.width();
    const int h = field.height();
    ImageF cones(w, h, 2);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const float apex = field.texels(x, y);
            float q = 1.0f;
            for (int j = 0; j < h; ++j)
                for (int i = 0; i < w; ++i) {
                    const float rise = field.texels(i, j) - apex;
                    if (rise <= 0) continue;
                    const int di = std::min(std::abs(i - x), w - std::abs(i - x));
                    const int dj = std::min(std::abs(j - y), h - std::abs(j - y));
                    const float u = static_cast<float>(di) / static_cast<float>(w);
                    const float v = static_cast<float>(dj) / static_cast<float>(h);
                    q = std::min(q, (u * u + v * v) / (rise * rise));
                }
            cones(x, y, 0) = apex;
            cones(x, y, 1) = std::sqrt(q);
        }
    return cones;
}

TEST(ConeMap, FlatFieldIsWideOpen) {
    for (const float level : {0.0f, 0.3f, 1.0f}) {
        const ImageF cones = cone_map(HeightField(9, 4, level));
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 9; ++x) {
                EXPECT_EQ(cones(x, y, 0), level);
                EXPECT_EQ(cones(x, y, 1), 1.0f);
            }
    }
}

// A spike of height 1 on the floor: the ratio is the distance to its nearest repeat, in UV.
TEST(ConeMap, SingleSpikeGivesTheDistanceToIt) {
    const int w = 24;
    const int h = 10;
    const ImageF cones = cone_map(test::spike_field(w, h, 3, 8));
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const double di = std::min(std::abs(x - 3), w - std::abs(x - 3));
            const double dj = std::min(std::abs(y - 8), h - std::abs(y - 8));
            const double expected = di + dj == 0 ? 1.0 : std::hypot(di / w, dj / h);
            EXPECT_NEAR(cones(x, y, 1), expected, 1e-6) << x << ' ' << y;
        }
}

// Left half floor, right half 0.5: the cone is limited by the nearer of the step's two edges.
TEST(ConeMap, StepIsLimitedByItsNearerEdge) {
    HeightField step(16, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 8; x < 16; ++x) step.texels(x, y) = 0.5f;
    const ImageF cones = cone_map(step);
    for (int x = 0; x < 8; ++x) EXPECT_NEAR(cones(x, 1, 1), std::min(x + 1, 8 - x) / 16.0 / 0.5, 1e-6) << x;
    for (int x = 8; x < 16; ++x) EXPECT_EQ(cones(x, 1, 1), 1.0f);
}

TEST(ConeMap, EqualsTheDefinitionToTheLastBit) {
    constexpr int sizes[][2] = {{1, 1}, {1, 2}, {2, 1}, {3, 3}, {1, 40}, {40, 1}, {7, 31}, {32, 32}, {33, 9}, {49, 50}, {64, 20}, {37, 67}};
    for (const auto& s : sizes)
        for (unsigned seed = 0; seed < (s[0] * s[1] < 1100 ? 2u : 1u); ++seed)
            for (const HeightField& field : {test::random_field(s[0], s[1], seed), test::terraced_field(s[0], s[1], seed),
                                             test::smooth_field(s[0], s[1], seed), test::spike_field(s[0], s[1], s[0] / 3, s[1] / 2)})
                ASSERT_EQ(cone_map(field).texels, by_definition(field).texels) << s[0] << 'x' << s[1] << " seed " << seed;
}

// Heights apart by less than a float's square can hold, and by nearly everything.
TEST(ConeMap, TinyRisesDoNotUnderflow) {
    HeightField field(8, 8, 0.0f);
    field.texels(1, 1) = 1e-30f;
    field.texels(5, 2) = 1e-38f;
    field.texels(6, 6) = 1.0f;
    EXPECT_EQ(cone_map(field).texels, by_definition(field).texels);
}

TEST(ConeMap, DoesNotDependOnThreads) {
    const HeightField field = test::smooth_field(150, 90, 8);
    const ImageF one = cone_map(field, 1);
    EXPECT_EQ(one.texels, cone_map(field, 2).texels);
    EXPECT_EQ(one.texels, cone_map(field, 7).texels);
}

TEST(ConeMap, ReportsProgressAndStopsWhenCancelled) {
    double last = 0;
    cone_map(test::random_field(64, 64, 1), 2, [&](std::string_view stage, double share) {
        EXPECT_FALSE(stage.empty());
        EXPECT_GE(share, last);
        EXPECT_LE(share, 1.0);
        last = share;
    });
    EXPECT_EQ(last, 1.0);
    int calls = 0;
    EXPECT_THROW(cone_map(test::random_field(256, 256, 1), 2,
                          [&](std::string_view, double) {
                              if (++calls == 2) throw Cancelled();
                          }),
                 Cancelled);
}

}  // namespace
}  // namespace relievo
