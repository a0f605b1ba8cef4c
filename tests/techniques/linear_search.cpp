// Steep parallax mapping (McGuire & McGuire 2005): hits are late by less than a step and never early, lie on the slices the steps
// cut, and what is thinner than a step may not be there at all.
#include "contract/profile.h"
#include "contract/trace.h"

namespace relievo::contract {
namespace {

constexpr float height_scale = 0.1f;

TEST(LinearSearch, is_late_by_less_than_a_step_and_lies_on_a_slice) {
    const Profile ramp{.name = "ramp", .kinks = {{4, 0.0}, {60, 1.0}}};
    const MapSet maps = baked_maps(ramp.field(), height_scale);
    MarchParams params = default_params(*find_technique("linear_search"));
    for (const int steps : {5, 16, 100}) {
        params.max_steps = steps;
        for (int i = 0; i < 64; ++i) {
            const float u = 0.3f + 0.4f * static_cast<float>(i) / 64;
            const SurfaceRay ray = glsl::view_ray({u, 0.5f}, view_from(50, i % 2 ? 0 : 180), height_scale, 0.5f, finest);
            const double z = trace(*find_technique("linear_search"), maps, ray, params).hit.height;
            const double late = truth(maps.height, ray).height - z;
            EXPECT_GE(late, -1e-5);
            EXPECT_LE(late, 1.0 / steps + 1e-5);
            EXPECT_NEAR(z * steps, std::round(z * steps), 1e-4);
        }
    }
}

TEST(LinearSearch, sees_what_stands_at_the_top_where_it_stands) {
    const MapSet maps = baked_maps(HeightField(8, 8, 1.0f), height_scale);
    const SurfaceRay ray = glsl::view_ray({0.2f, 0.2f}, view_from(30, 0), height_scale, 1.0f, finest);
    EXPECT_EQ(trace(*find_technique("linear_search"), maps, ray, default_params(*find_technique("linear_search"))).hit.uv, ray.uv);
}

// A fence a texel wide; the ray is inside it for a 40th of its way, and 16 steps do not notice.
TEST(LinearSearch, steps_over_a_spike_that_maximum_mipmaps_find) {
    const Profile fence{.name = "fence", .kinks = {{31, 0.0}, {32, 1.0}, {33, 0.0}}};
    const MapSet maps = baked_maps(fence.field(), 0.3f);
    MarchParams params = default_params(*find_technique("linear_search"));
    params.max_steps = 16;
    int behind = 0;
    int missed = 0;
    int missed_by_max_mip = 0;
    for (int i = 0; i < 200; ++i) {
        const SurfaceRay ray = glsl::view_ray({static_cast<float>(i) / 200, 0.5f}, view_from(20, 0), 0.3f, 1.0f, finest);
        const ReferenceHit first = truth(maps.height, ray);
        if (first.height < 0.1) continue;
        ++behind;
        missed += trace(*find_technique("linear_search"), maps, ray, params).hit.height < first.height - 0.1 ? 1 : 0;
        const Technique& exact = *find_technique("max_mip_tracing");
        missed_by_max_mip += std::abs(trace(exact, maps, ray, default_params(exact)).hit.height - first.height) > 1e-4 ? 1 : 0;
    }
    EXPECT_GT(behind, 100);
    EXPECT_GT(missed, behind / 4);
    EXPECT_EQ(missed_by_max_mip, 0);
}

}  // namespace
}  // namespace relievo::contract
