// Fur maps against the promises of the algorithm, counted texel by texel.
#include "fur/fur_map.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relievo {
namespace {

std::uint32_t strands_of(const Image8& texels) {
    std::uint32_t n = 0;
    for (std::size_t t = 0; t < texels.texels.size(); t += 4) {
        EXPECT_TRUE(texels.texels[t] == 255 && texels.texels[t + 1] == 255 && texels.texels[t + 2] == 255);
        EXPECT_TRUE(texels.texels[t + 3] == 0 || texels.texels[t + 3] == 255);
        n += texels.texels[t + 3] == 255;
    }
    return n;
}

TEST(FurMap, HasAsManyStrandsAsItsDensityAsksFor) {
    for (const double density : {0.0, 0.1, 0.2, 0.731, 1.0}) {
        const FurMap map = fur_map({.width = 64, .height = 48, .density = density});
        EXPECT_EQ(map.strands, std::lround(density * 64 * 48));
        EXPECT_EQ(map.wanted, map.strands);
        EXPECT_EQ(strands_of(map.texels), map.strands);
    }
}

TEST(FurMap, KeepsStrandsApart) {
    for (const double apart : {1.0, 1.5, 3.0, 5.2}) {
        const FurMap map = fur_map({.width = 80, .height = 60, .density = 1, .apart = apart, .seed = 7});
        EXPECT_LT(map.strands, map.wanted);
        EXPECT_EQ(strands_of(map.texels), map.strands);
        // No two are near, and no free texel is left: every texel is a strand or near one.
        const int reach = static_cast<int>(apart);
        for (int y = 0; y < 60; ++y)
            for (int x = 0; x < 80; ++x) {
                int near = 0;
                for (int v = std::max(0, y - reach); v <= std::min(59, y + reach); ++v)
                    for (int u = std::max(0, x - reach); u <= std::min(79, x + reach); ++u)
                        near += map.texels(u, v, 3) == 255 && (u - x) * (u - x) + (v - y) * (v - y) <= apart * apart;
                if (map.texels(x, y, 3) == 255) {
                    ASSERT_EQ(near, 1) << x << ' ' << y;
                } else {
                    ASSERT_GE(near, 1) << x << ' ' << y;
                }
            }
    }
    // Free texels in a checkerboard at the most where neighbours at the side are blocked, a quarter where diagonal ones are too.
    EXPECT_LE(fur_map({.width = 64, .height = 64, .density = 1, .apart = 1}).strands, 64u * 64 / 2);
    EXPECT_LE(fur_map({.width = 64, .height = 64, .density = 1, .apart = 1.5}).strands, 64u * 64 / 4);
}

TEST(FurMap, IsItsSeedsAndAsLikelyEverywhere) {
    const FurMapSettings settings{.width = 128, .height = 128, .density = 0.2, .seed = 3};
    EXPECT_EQ(fur_map(settings).texels.texels, fur_map(settings).texels.texels);
    FurMapSettings other = settings;
    other.seed = 4;
    EXPECT_NE(fur_map(settings).texels.texels, fur_map(other).texels.texels);
    // Over 400 seeds each texel of a small map is taken 80 times, give or take 8; five times that is never seen in 64 of them.
    std::vector<int> taken(64, 0);
    for (std::uint32_t seed = 0; seed < 400; ++seed) {
        const FurMap map = fur_map({.width = 8, .height = 8, .density = 0.2, .seed = seed});
        for (std::size_t t = 0; t < 64; ++t) taken[t] += map.texels.texels[t * 4 + 3] == 255;
    }
    for (const int n : taken) EXPECT_NEAR(n, 80, 40);
}

}  // namespace
}  // namespace relievo
