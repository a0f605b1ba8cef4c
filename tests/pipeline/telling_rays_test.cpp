// Rays worth a figure, on frames whose every pixel is known.
#include "pipeline/telling_rays.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

// A picture of 8 x 1 rays along +u from an eye at +u, 64 texels; every hit on the truth, at height 0.5, after ten fetches.
struct Pictures {
    Frame picture{8, 1}, truth{8, 1};
    RayField rays{8, 1};
    Pictures() {
        for (int x = 0; x < 8; ++x) {
            picture.coverage(x, 0) = truth.coverage(x, 0) = rays.coverage(x, 0) = static_cast<std::uint8_t>(Coverage::hit);
            rays.view(x, 0, 0) = 0.6f, rays.view(x, 0, 2) = 0.8f;
            truth.hit_height(x, 0) = 0.5f;
            picture.fetches(x, 0) = 10;
        }
    }
    // Along the ray is toward -u.
    void late(int x, double texels) { picture.hit_uv(x, 0, 0) = static_cast<float>(-texels / 64); }
    TellingRays telling() const { return telling_rays(picture, truth, rays, {64, 64}); }
};

TEST(TellingRays, MissesAreHardAndTheRestTypical) {
    Pictures p;
    p.late(2, 3), p.late(4, 9), p.late(6, 30);
    p.late(1, -20);  // early is wrong, but no miss
    for (int x = 0; x < 8; ++x) p.picture.fetches(x, 0) = static_cast<float>(x);
    EXPECT_EQ(p.telling().hard.x, 4) << "the median of the misses";
    EXPECT_EQ(p.telling().typical.x, 3) << "the lower median of 0, 3, 5, 7 by fetches";
}

TEST(TellingRays, WithoutMissesTheDearestIsHard) {
    Pictures p;
    p.picture.fetches(5, 0) = 90;
    EXPECT_EQ(p.telling().hard.x, 5);
    // What is hit near the top shows little, and is not typical while there is anything else.
    for (int x = 0; x < 7; ++x) p.truth.hit_height(x, 0) = 0.95f;
    EXPECT_EQ(p.telling().typical.x, 7);
    p.truth.hit_height(7, 0) = 0.95f;
    EXPECT_LT(p.telling().typical.x, 8);
}

TEST(TellingRays, PixelsWithoutAHitAreNotShown) {
    Pictures p;
    for (int x = 0; x < 7; ++x) p.picture.coverage(x, 0) = static_cast<std::uint8_t>(x % 2 == 0 ? Coverage::no_hit : Coverage::background);
    EXPECT_EQ(p.telling().typical.x, 7);
    EXPECT_EQ(p.telling().hard.x, 7);
}

}  // namespace
}  // namespace relievo
