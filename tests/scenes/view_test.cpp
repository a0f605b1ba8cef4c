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
    EXPECT_EQ(parse_view("-35@2")->elevation_deg, -35);
    EXPECT_TRUE(parse_view("-35")->from_behind());
    EXPECT_FALSE(parse_view("35")->from_behind());
    for (const char* wrong : {"-0.5", "-91", "-grazing", "", "@", "@2", "grazing@", "grazing@0", "grazing@101", "grazing@nan", "grazing@2x", "grazing@2@2", "0@2", "91", "nan", "2e9", "grazin@2"})
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

// From behind: the rays of a camera that really stands below, of which the world is turned over.
TEST(View, fromBehindIsTheMirroredWorld) {
    const View view{.id = "test", .elevation_deg = -40};
    const Stage stage = stage_for(view);
    Camera below = stage.camera;
    below.from_behind = false;
    below.eye.z = -below.eye.z;
    const RayField rays = quad_rays(stage, 48, 30, {0, 0});
    int covered = 0;
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 48; ++x) {
            const Vec3d d = below.ray({x + 0.5, y + 0.5}, 48, 30);
            if (rays.coverage(x, y) == 0) continue;
            ++covered;
            const double t = -below.eye.z / d.z;
            ASSERT_NEAR(rays.uv(x, y, 0), below.eye.x + t * d.x + 1.5, 1e-5);
            ASSERT_NEAR(rays.uv(x, y, 1), below.eye.y + t * d.y + 1.5, 1e-5);
            ASSERT_NEAR(rays.view(x, y, 0), -d.x, 1e-6);
            ASSERT_NEAR(rays.view(x, y, 1), -d.y, 1e-6);
            ASSERT_NEAR(rays.view(x, y, 2), d.z, 1e-6) << "toward the eye, of which the world is mirrored";
        }
    EXPECT_GT(covered, 700);
}

}  // namespace
}  // namespace relievo
