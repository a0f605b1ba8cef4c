// What a ray passes through: against closed forms on profiles, and against the reference's own first hit on rough ground.
#include "reference/solids.h"

#include "contract/profile.h"
#include "contract/random_fields.h"

#include <gtest/gtest.h>

#include <random>

namespace relievo {
namespace {

using contract::Profile;

TEST(Solids, AreThoseOfAProfile) {
    const std::vector<Profile> profiles{{.name = "teeth", .kinks = {{4, 0.1}, {10, 0.9}, {14, 0.1}, {30, 0.7}, {33, 0.1}, {50, 0.3}}},
                                        {.name = "steps", .kinks = {{20, 0.2}, {21, 0.8}, {44, 0.8}, {45, 0.2}}}};
    int solids = 0;
    for (const Profile& profile : profiles) {
        const HeightField field = profile.field();
        for (const float slope : {0.05f, 0.3f, -0.4f, 1.3f}) {
            for (int k = 0; k < 40; ++k) {
                glsl::SurfaceRay ray{};
                ray.uv = {static_cast<float>(k) / 40 + 0.011f, 0.3f};
                ray.uv_per_height = {slope, 0.02f};
                ray.zero_level = 0.5f;
                ray.z_start = 1;
                ray.z_end = 0;
                const auto expected = profile.solids(ray);
                RaySolids found;
                append_solids(found, field, {.uv = Vec2d(ray.uv), .uv_per_height = Vec2d(ray.uv_per_height), .zero_level = 0.5});
                ASSERT_EQ(found.rays.size(), 1u);
                ASSERT_EQ(found.of(0).size(), expected.size()) << profile.name << " " << slope << " " << k;
                for (std::size_t i = 0; i < expected.size(); ++i) {
                    EXPECT_NEAR(static_cast<double>(found.of(0)[i].enter), expected[i].enter, 1e-5);
                    EXPECT_NEAR(static_cast<double>(found.of(0)[i].leave), expected[i].leave, 1e-5);
                }
                solids += static_cast<int>(expected.size());
                // Heights between polygon and hit, sampled.
                double low = 2, high = -1;
                for (int i = 0; i <= 4000; ++i) {
                    const double z = 0.5 + (expected[0].enter - 0.5) * i / 4000;
                    const double h = profile.height(Profile::x_at(ray, z));
                    low = std::min(low, h), high = std::max(high, h);
                }
                EXPECT_NEAR(static_cast<double>(found.rays[0].lowest), low, 2e-3);
                EXPECT_NEAR(static_cast<double>(found.rays[0].highest), high, 2e-3);
            }
        }
    }
    EXPECT_GT(solids, 400) << "of 320 rays many pass more than one";
}

TEST(Solids, BeginWhereTheFirstHitIs) {
    const HeightField field = contract::rough_field(5);
    std::mt19937 random(3);
    const auto unit = [&] { return static_cast<double>(random() >> 8) / 16777216.0; };
    for (int k = 0; k < 3000; ++k) {
        const ReferenceRay ray{.uv = {unit(), unit()}, .uv_per_height = {unit() - 0.5, unit() - 0.5}, .zero_level = unit()};
        RaySolids found;
        append_solids(found, field, ray);
        ASSERT_GE(found.of(0).size(), 1u);
        // A touch without thickness is a hit of the reference and may be no solid; what comes after it is no earlier.
        const double first = reference_cast(field, ray).height;
        EXPECT_LE(static_cast<double>(found.of(0)[0].enter), first + 1e-6);
        if (first > 0) {
            EXPECT_GE(static_cast<double>(found.of(0)[0].enter), first - 1e-6);
        }
        for (std::size_t i = 1; i < found.of(0).size(); ++i) EXPECT_LE(found.of(0)[i].enter, found.of(0)[i - 1].leave);
    }
}

TEST(Solids, EndOnTheFloor) {
    const HeightField floor(8, 8, 0.0f);
    RaySolids found;
    append_solids(found, floor, {.uv = {0.3, 0.3}, .uv_per_height = {0.2, 0.1}});
    ASSERT_EQ(found.of(0).size(), 1u);
    EXPECT_EQ(found.of(0)[0].enter, 0);
    // A shadow ray ends above the floor and meets nothing.
    append_solids(found, floor, {.uv = {0.3, 0.3}, .uv_per_height = {0.2, 0.1}, .zero_level = 1, .z_start = 1, .z_end = 0.1});
    EXPECT_EQ(found.of(1).size(), 0u);
}

}  // namespace
}  // namespace relievo
