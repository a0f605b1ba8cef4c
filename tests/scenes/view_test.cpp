// Views by name, by angle and by distance, and what a distance means: the same picture of a base that many times wider.
#include "scenes/scene.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

TEST(View, isParsedByNameAngleAndDistance) {
    EXPECT_EQ(parse_view("grazing")->elevation_deg, 15);
    EXPECT_EQ(parse_view("grazing")->distance, 1);
    EXPECT_EQ(parse_view("grazing@4")->elevation_deg, 15);
    EXPECT_EQ(parse_view("grazing@4")->distance, 4);
    EXPECT_EQ(parse_view("22.5@0.5")->elevation_deg, 22.5);
    EXPECT_EQ(parse_view("22.5@0.5")->distance, 0.5);
    EXPECT_EQ(parse_view("22.5@0.5")->id, "22.5@0.5");
    for (const char* wrong : {"", "@", "@2", "grazing@", "grazing@0", "grazing@101", "grazing@nan", "grazing@2x", "grazing@2@2", "0@2", "91", "nan", "2e9", "grazin@2"})
        EXPECT_FALSE(parse_view(wrong).has_value()) << wrong;
}

// Every ray has its place on the base in twice the repeats, under the same angle; a pixel covers twice the texels.
TEST(View, distanceMultipliesTheRepeatsUnderEveryPixel) {
    for (const double times : {0.5, 2.0, 8.0}) {
        View view{.id = "test", .elevation_deg = 30};
        const RayField usual = quad_rays(stage_for(view), 48, 30, {0, 0});
        view.distance = times;
        const RayField far = quad_rays(stage_for(view), 48, 30, {0, 0});
        int covered = 0;
        for (std::size_t i = 0; i < usual.lod.texels.size(); ++i) {
            ASSERT_EQ(usual.coverage.texels[i], far.coverage.texels[i]);
            if (usual.coverage.texels[i] == 0) continue;
            ++covered;
            for (std::size_t c = 0; c < 2; ++c) ASSERT_NEAR(far.uv.texels[2 * i + c], times * usual.uv.texels[2 * i + c], 1e-5 * times);
            for (std::size_t c = 0; c < 3; ++c) ASSERT_NEAR(far.view.texels[3 * i + c], usual.view.texels[3 * i + c], 1e-5);
            ASSERT_NEAR(far.lod.texels[i], usual.lod.texels[i] + std::log2(times), 1e-4);
        }
        EXPECT_GT(covered, 1000);
    }
}

}  // namespace
}  // namespace relievo
