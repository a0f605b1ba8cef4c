#include "maps/mip_chain.h"

#include "core/vec.h"
#include "maps/fields.h"
#include "maps/normal_map.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace relievo {
namespace {

TEST(MipChain, HasVulkansSizesDownToOne) {
    const auto chain = colour_mip_chain(Image8(13, 6, 4, std::uint8_t{9}));
    ASSERT_EQ(chain.size(), 4u);
    for (std::size_t k = 0; k < chain.size(); ++k) {
        EXPECT_EQ(chain[k].width, std::max(1, 13 >> k));
        EXPECT_EQ(chain[k].height, std::max(1, 6 >> k));
    }
    EXPECT_EQ(colour_mip_chain(Image8(1, 1, 4)).size(), 1u);
    EXPECT_EQ(normal_mip_chain(normal_map(HeightField(490, 490), 0.1f)).size(), 9u);
}

// Black and white in equal parts is half the light, which is code 188, not 128.
TEST(MipChain, ColourIsAveragedInLinearLight) {
    Image8 checker(2, 2, 4, std::uint8_t{255});
    for (int c = 0; c < 3; ++c) checker(0, 0, c) = checker(1, 1, c) = 0;
    checker(0, 0, 3) = 0;
    const auto chain = colour_mip_chain(checker);
    EXPECT_EQ(chain[1](0, 0, 0), 188);
    EXPECT_EQ(chain[1](0, 0, 3), 191);  // alpha is linear: 3/4 of 255
}

TEST(MipChain, ConstantColourStaysForEveryCodeAndSize) {
    for (int code = 0; code < 256; ++code) {
        const auto value = static_cast<std::uint8_t>(code);
        for (const Image8& level : colour_mip_chain(Image8(7, 3, 4, value)))
            for (const std::uint8_t texel : level.texels) ASSERT_EQ(texel, value);
    }
}

// 3 -> 1 and 5 -> 2: area weights 1/3 each, and (2, 2, 1)/5, (1, 2, 2)/5.
TEST(MipChain, OddSizesWeighByArea) {
    Image8 three(3, 1, 4);
    three(2, 0, 0) = 255;
    EXPECT_EQ(colour_mip_chain(three)[1](0, 0, 0), std::lround(255 * linear_to_srgb(1.0f / 3)));
    Image8 five(5, 1, 4);
    five(2, 0, 0) = 255;
    five(4, 0, 1) = 255;
    const auto chain = colour_mip_chain(five);
    EXPECT_EQ(chain[1](0, 0, 0), std::lround(255 * linear_to_srgb(0.2f)));
    EXPECT_EQ(chain[1](1, 0, 0), std::lround(255 * linear_to_srgb(0.2f)));
    EXPECT_EQ(chain[1](1, 0, 1), std::lround(255 * linear_to_srgb(0.4f)));
    EXPECT_EQ(chain[2](0, 0, 1), std::lround(255 * linear_to_srgb(0.2f)));
}

TEST(MipChain, LastLevelIsTheMeanOfTheFirst) {
    const HeightField field = test::random_field(61, 37, 4);
    Image8 colour(61, 37, 4);
    double sum = 0;
    for (std::size_t k = 0; k < colour.texels.size(); ++k) {
        colour.texels[k] = static_cast<std::uint8_t>(field.texels.texels[k / 4] * 255.0f);
        if (k % 4 == 0) sum += srgb_to_linear(static_cast<float>(colour.texels[k]) / 255.0f);
    }
    EXPECT_EQ(colour_mip_chain(colour).back()(0, 0), std::lround(255 * linear_to_srgb(static_cast<float>(sum / (61 * 37)))));
}

TEST(MipChain, NormalsAreUnitMeansOfTheFirstLevel) {
    const auto chain = normal_mip_chain(normal_map(test::random_field(19, 30, 2), 0.05f));
    Vec3d mean{0, 0, 0};
    for (std::size_t k = 0; k < chain[0].texels.size(); k += 3)
        mean += Vec3d{chain[0].texels[k], chain[0].texels[k + 1], chain[0].texels[k + 2]};
    mean = normalize(mean);
    EXPECT_NEAR(chain.back()(0, 0, 0), mean.x, 1e-5);
    EXPECT_NEAR(chain.back()(0, 0, 1), mean.y, 1e-5);
    for (const ImageF& level : chain)
        for (std::size_t k = 0; k < level.texels.size(); k += 3)
            ASSERT_NEAR(length(Vec3f{level.texels[k], level.texels[k + 1], level.texels[k + 2]}), 1.0f, 1e-6);
}

TEST(MipChain, OppositeNormalsGiveUpward) {
    ImageF opposite(2, 1, 3);
    opposite(0, 0, 0) = 1;
    opposite(1, 0, 0) = -1;
    const auto chain = normal_mip_chain(opposite);
    EXPECT_EQ(chain[1](0, 0, 2), 1.0f);
    EXPECT_EQ(chain[1](0, 0, 0), 0.0f);
}

TEST(MipChain, SrgbCurveHasItsKnownPointsAndInverts) {
    EXPECT_NEAR(srgb_to_linear(0.5f), 0.21404114, 1e-6);
    EXPECT_EQ(srgb_to_linear(0.0f), 0.0f);
    EXPECT_NEAR(srgb_to_linear(1.0f), 1.0f, 1e-6);
    for (int i = 0; i <= 100; ++i) EXPECT_NEAR(linear_to_srgb(srgb_to_linear(static_cast<float>(i) / 100)), i / 100.0, 1e-5);
}

TEST(MipChain, DoesNotDependOnThreads) {
    const ImageF normals = normal_map(test::random_field(101, 77, 9), 0.1f);
    const auto one = normal_mip_chain(normals, 1);
    const auto four = normal_mip_chain(normals, 4);
    for (std::size_t k = 0; k < one.size(); ++k) EXPECT_EQ(one[k].texels, four[k].texels);
}

}  // namespace
}  // namespace relievo
