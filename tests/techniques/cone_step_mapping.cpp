// Cone step mapping (Dummer 2006): a leap ends on the wall of a cone that holds no texel, so a slope that fills its cone is reached
// at once, a level field is approached by the same factor each time, and a valley is never passed through.
#include "contract/profile.h"
#include "contract/trace.h"

namespace relievo::contract {
namespace {

const Technique& technique() { return *find_technique("cone_step_mapping"); }

TEST(ConeStepMapping, reaches_a_slope_that_rises_toward_the_ray_in_one_leap) {
    // Steeper than one repeat per unit of height, or the cone's largest ratio of 1 would end the leap before the slope does.
    const Profile ramp{.name = "ramp", .kinks = {{20, 0.1}, {44, 0.9}, {62, 0.9}}};
    const MapSet maps = baked_maps(ramp.field(), 0.1f);
    const SurfaceRay ray = glsl::view_ray({0.5f, 0.5f}, view_from(45, 180), 0.1f, 0.5f, finest);
    const auto [hit, fetches] = trace(technique(), maps, ray, default_params(technique()));
    EXPECT_EQ(fetches, 2);
    EXPECT_NEAR(hit.height, truth(maps.height, ray).height, 1e-5);
}

// With the widest cone, c = 1, each leap leaves R / (1 + R) of the gap, R the ray's UV speed.
TEST(ConeStepMapping, approaches_a_level_field_geometrically) {
    const MapSet maps = baked_maps(HeightField(8, 8, 0.2f), 0.3f);
    const SurfaceRay ray = glsl::view_ray({0.2f, 0.2f}, view_from(15, 33), 0.3f, 1.0f, finest);
    const double speed = length(ray.uv_per_height);
    MarchParams params = default_params(technique());
    for (int steps = 1; steps < 6; ++steps) {
        params.max_steps = steps;
        const double gap = static_cast<double>(trace(technique(), maps, ray, params).hit.height) - 0.2;
        EXPECT_NEAR(gap, 0.8 * std::pow(speed / (1 + speed), steps), 1e-5);
    }
}

TEST(ConeStepMapping, never_passes_through_a_valley) {
    const Profile valley{.name = "valley", .kinks = {{2, 1.0}, {20, 0.3}, {32, 0.0}, {40, 0.1}, {62, 1.0}}, .first = 3, .last = 61};
    const MapSet maps = baked_maps(valley.field(), 0.2f);
    int rays = 0;
    for (const double elevation : {70.0, 40.0, 20.0}) {
        for (const double azimuth : {0.0, 180.0, 50.0, 110.0}) {
            for (int i = 0; i < 100; ++i) {
                const SurfaceRay ray = glsl::view_ray({static_cast<float>(i) / 100, 0.5f}, view_from(elevation, azimuth), 0.2f, 0.5f, finest);
                if (!valley.contains(ray)) continue;
                ++rays;
                EXPECT_GE(valley.gap(ray, trace(technique(), maps, ray, default_params(technique())).hit.height), -1e-5);
            }
        }
    }
    EXPECT_GT(rays, 300);
}

}  // namespace
}  // namespace relievo::contract
