// Parallax occlusion mapping (Tatarchuk 2006): the secant is exact where the field is a plane between two samples, the first two
// included; the number of samples grows as the view flattens, n = n_min + (n_max - n_min)(1 - cos alpha).
#include "contract/profile.h"
#include "contract/trace.h"

namespace relievo::contract {
namespace {

const Technique& technique() { return *find_technique("parallax_occlusion_mapping"); }

TEST(ParallaxOcclusionMapping, is_exact_on_planes_with_few_steps) {
    const Profile ramp{.name = "ramp", .kinks = {{4, 0.0}, {60, 1.0}}};
    const MapSet maps = baked_maps(ramp.field(), 0.1f);
    MarchParams params = default_params(technique());
    params.max_steps = params.min_steps = 3;
    for (int i = 0; i < 64; ++i) {
        const float u = 0.3f + 0.4f * static_cast<float>(i) / 64;
        const SurfaceRay ray = glsl::view_ray({u, 0.5f}, view_from(50, i % 2 ? 0 : 180), 0.1f, 0.5f, finest);
        EXPECT_NEAR(trace(technique(), maps, ray, params).hit.height, truth(maps.height, ray).height, 1e-5);
    }
}

TEST(ParallaxOcclusionMapping, is_exact_within_the_first_step_and_at_the_top) {
    for (const float height : {0.8f, 0.99f, 1.0f}) {
        const MapSet maps = baked_maps(HeightField(8, 8, height), 0.1f);
        MarchParams params = default_params(technique());
        params.max_steps = params.min_steps = 4;
        const SurfaceRay ray = glsl::view_ray({0.2f, 0.2f}, view_from(30, 0), 0.1f, 1.0f, finest);
        EXPECT_NEAR(trace(technique(), maps, ray, params).hit.height, height, 1e-6);
    }
}

TEST(ParallaxOcclusionMapping, takes_more_samples_the_flatter_the_view) {
    const MapSet floor = baked_maps(HeightField(8, 8, 0.0f), 0.1f);
    MarchParams params = default_params(technique());
    params.min_steps = 10;
    params.max_steps = 50;
    for (const double elevation : {90.0, 60.0, 30.0, 5.0}) {
        const SurfaceRay ray = glsl::view_ray({0.2f, 0.2f}, view_from(elevation, 10), 0.1f, 1.0f, finest);
        const double cosine = std::sin(elevation * std::numbers::pi / 180);
        EXPECT_NEAR(trace(technique(), floor, ray, params).fetches, 1 + 10 + 40 * (1 - cosine), 0.51) << elevation;
    }
}

}  // namespace
}  // namespace relievo::contract
