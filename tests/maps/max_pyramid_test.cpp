#include "maps/max_pyramid.h"

#include "maps/fields.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

struct Size {
    int width, height;
};
constexpr Size awkward[] = {{1, 1}, {2, 2}, {1, 7}, {3, 5}, {16, 16}, {17, 64}, {490, 490}, {300, 7}, {64, 1}, {33, 100}};

TEST(MaxPyramid, SizesAreAVulkanMipChainOfThePaddedSize) {
    for (const Size s : awkward) {
        const MaxPyramid p = max_pyramid(HeightField(s.width, s.height, 0.5f));
        const int levels = static_cast<int>(p.levels.size());
        EXPECT_EQ(p.cells_x, s.width);
        EXPECT_EQ(p.cells_y, s.height);
        EXPECT_EQ(levels, max_pyramid_levels(s.width, s.height));
        for (int k = 0; k < levels; ++k) {
            EXPECT_EQ(p.levels[static_cast<std::size_t>(k)].width, p.levels[0].width >> k);
            EXPECT_EQ(p.levels[static_cast<std::size_t>(k)].height, p.levels[0].height >> k);
        }
        EXPECT_EQ(p.levels[0].width % (1 << (levels - 1)), 0);
        EXPECT_EQ(p.levels[0].height % (1 << (levels - 1)), 0);
        EXPECT_LE(p.levels[0].texels.size(), std::size_t{4} * static_cast<std::size_t>(s.width * s.height));
    }
}

TEST(MaxPyramid, TopIsFourToEightNodesAcross) {
    EXPECT_EQ(max_pyramid_levels(1, 1), 1);
    EXPECT_EQ(max_pyramid_levels(1024, 1024), 9);
    EXPECT_EQ(max_pyramid_levels(490, 490), 7);
    const MaxPyramid p = max_pyramid(HeightField(490, 490));
    EXPECT_EQ(p.levels.back().width, 8);
    EXPECT_EQ(p.levels[0].width, 512);
}

// One texel raises the four cells around it, across the seam too.
TEST(MaxPyramid, SpikeAtTheOriginRaisesItsFourCells) {
    const MaxPyramid p = max_pyramid(test::spike_field(8, 8, 0, 0));
    for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 8; ++i) EXPECT_EQ(p.levels[0](i, j), (i == 0 || i == 7) && (j == 0 || j == 7) ? 1.0f : 0.0f) << i << ' ' << j;
}

TEST(MaxPyramid, EveryNodeIsTheMaximumOfItsCellsAndPaddingIsZero) {
    for (const Size s : awkward) {
        const HeightField field = test::random_field(s.width, s.height, 7);
        const MaxPyramid p = max_pyramid(field);
        for (std::size_t k = 0; k < p.levels.size(); ++k) {
            const ImageF& level = p.levels[k];
            ImageF expected(level.width, level.height, 1, 0.0f);
            for (int j = 0; j < s.height; ++j)
                for (int i = 0; i < s.width; ++i)
                    for (const float corner : field.cell(i, j)) {
                        float& e = expected(i >> k, j >> k);
                        e = std::max(e, corner);
                    }
            ASSERT_EQ(level.texels, expected.texels) << s.width << 'x' << s.height << " level " << k;
        }
    }
}

TEST(MaxPyramid, DoesNotDependOnThreads) {
    const HeightField field = test::random_field(317, 211, 3);
    const MaxPyramid one = max_pyramid(field, 1);
    const MaxPyramid five = max_pyramid(field, 5);
    ASSERT_EQ(one.levels.size(), five.levels.size());
    for (std::size_t k = 0; k < one.levels.size(); ++k) EXPECT_EQ(one.levels[k].texels, five.levels[k].texels);
}

}  // namespace
}  // namespace relievo
