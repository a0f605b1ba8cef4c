#include "maps/cell_cone.h"

#include "core/error.h"
#include "core/map_set.h"
#include "maps/cell_cone_verifier.h"
#include "maps/fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace relievo {
namespace {

constexpr int reaches[] = {0, near_roof_reach, middle_roof_reach, far_roof_reach};

// Every channel of every quadrant, from the corners of the cells one by one.
void expect_highest_ahead(const HeightField& f) {
    const int w = f.width();
    const int h = f.height();
    const ImageF map = cell_cone_map(f);
    ASSERT_EQ(map.channels, 4);
    ASSERT_EQ(map.width, w);
    ASSERT_EQ(map.height, 4 * h);
    for (int quadrant = 0; quadrant < cell_cone_quadrants; ++quadrant)
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x)
                for (int k = 0; k < 4; ++k) {
                    float highest = 0;
                    for (int b = 0; b <= reaches[k]; ++b)
                        for (int a = 0; a <= reaches[k]; ++a) {
                            const auto corners = f.cell(x + (quadrant & 1 ? -a : a), y + (quadrant & 2 ? -b : b));
                            highest = std::max(highest, *std::ranges::max_element(corners));
                        }
                    const float roof = map(x, quadrant * h + y, k);
                    ASSERT_GE(roof, highest) << w << 'x' << h << " cell " << x << ' ' << y << " quadrant " << quadrant << " channel " << k;
                    ASSERT_LT(roof, highest + 1.01f / 255) << w << 'x' << h << " cell " << x << ' ' << y << " quadrant " << quadrant << " channel " << k;
                }
}

TEST(CellCone, FlatFieldIsItsOwnRoof) {
    for (const float level : {0.0f, 51 / 255.0f, 1.0f})
        for (const float v : cell_cone_map(HeightField(9, 4, level)).texels) EXPECT_EQ(v, level);
}

// A spike in one texel is a corner of four cells, and lifts the roofs of the cells that look at one of them.
TEST(CellCone, SpikeLiftsTheRoofsThatLookAtIt) {
    HeightField f(128, 100);
    f.texels(70, 50) = 1;
    const ImageF map = cell_cone_map(f);
    for (int quadrant = 0; quadrant < cell_cone_quadrants; ++quadrant)
        for (int y = 0; y < 100; ++y)
            for (int x = 0; x < 128; ++x)
                for (int k = 0; k < 4; ++k) {
                    const bool over_x = quadrant & 1 ? x >= 69 && x <= 70 + reaches[k] : x >= 69 - reaches[k] && x <= 70;
                    const bool over_y = quadrant & 2 ? y >= 49 && y <= 50 + reaches[k] : y >= 49 - reaches[k] && y <= 50;
                    ASSERT_EQ(map(x, quadrant * 100 + y, k), over_x && over_y ? 1.0f : 0.0f) << x << ' ' << y << ' ' << quadrant << ' ' << k;
                }
}

TEST(CellCone, RoofsAreTheHighestAhead) {
    constexpr int sizes[][2] = {{80, 37}, {16, 16}, {33, 34}, {13, 9}, {1, 1}, {2, 1}, {3, 2}, {1, 40}, {40, 1}, {5, 24}};
    for (const auto& s : sizes)
        for (const HeightField& field : {test::random_field(s[0], s[1], 3), test::terraced_field(s[0], s[1], 4), test::smooth_field(s[0], s[1], 5)})
            expect_highest_ahead(field);
}

// A device holds every channel in 8 bits without moving it.
TEST(CellCone, ValuesAreWholeNumbersOf8Bits) {
    HeightField field = test::random_field(40, 30, 9);
    for (int k = 0; k <= 255; ++k) field.texels(k % 40, 2 * (k / 40)) = static_cast<float>(k / 255.0);
    field.texels(0, 29) = 1e-38f;
    for (const float v : cell_cone_map(field).texels) ASSERT_EQ(v, static_cast<float>(std::round(v * 255.0) / 255.0));
}

TEST(CellCone, DoesNotDependOnThreads) {
    const HeightField field = test::smooth_field(150, 90, 8);
    const ImageF one = cell_cone_map(field, 1);
    EXPECT_EQ(one.texels, cell_cone_map(field, 2).texels);
    EXPECT_EQ(one.texels, cell_cone_map(field, 7).texels);
}

TEST(CellCone, IsProvenAndALoweredValueIsFound) {
    for (const auto& [w, h] : {std::pair{1, 1}, {16, 16}, {21, 10}, {70, 43}}) {
        const HeightField field = test::smooth_field(w, h, 3);
        ImageF map = cell_cone_map(field);
        const Verification kept = verify_cell_cone(field, map);
        EXPECT_EQ(kept.violated, 0u);
        EXPECT_EQ(kept.cones, map.texels.size());
        EXPECT_EQ(kept.pairs, static_cast<std::uint64_t>(4 * w * h) * (1 + 3 * 3 + 9 * 9 + 33 * 33));
        for (std::size_t k = 0; k < map.texels.size(); k += 7) {
            map.texels[k] -= 1.0f / 255;
            EXPECT_EQ(verify_cell_cone(field, map).violated, 1u) << k;
            map.texels[k] += 1.0f / 255;
            if (k > 700) break;
        }
    }
    EXPECT_THROW(verify_cell_cone(HeightField(4, 4), cell_cone_map(HeightField(5, 4))), Error);
}

TEST(CellCone, ReportsProgressAndStopsWhenCancelled) {
    double last = 0;
    cell_cone_map(test::random_field(64, 64, 1), 2, [&](std::string_view stage, double share) {
        EXPECT_FALSE(stage.empty());
        EXPECT_GE(share, last);
        EXPECT_LE(share, 1.0);
        last = share;
    });
    EXPECT_EQ(last, 1.0);
    // At the first report: on a busy machine the thread that reports may come to no second one before the end.
    EXPECT_THROW(cell_cone_map(test::random_field(256, 256, 1), 2, [](std::string_view, double) { throw Cancelled(); }), Cancelled);
}

}  // namespace
}  // namespace relievo
