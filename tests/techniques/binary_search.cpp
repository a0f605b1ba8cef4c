// Bisection alone (Policarpo, Oliveira, Comba 2005, without the linear search they put before it) finds a crossing to
// 2^-k of the ray, but behind the first of two walls as readily as on it.
#include "contract/profile.h"
#include "contract/trace.h"

namespace relievo::contract {
namespace {

TEST(BinarySearch, finds_the_crossing_behind_a_wall_that_it_does_not_see) {
    const Profile walls{.name = "two walls", .kinks = {{10, 0.0}, {11, 0.9}, {13, 0.9}, {14, 0.0}, {40, 0.0}, {41, 0.9}, {43, 0.9}, {44, 0.0}}};
    const MapSet maps = baked_maps(walls.field(), 0.15f);
    const Technique& technique = *find_technique("binary_search");
    // The eye is at -u: the ray enters the first wall at three quarters of its way down and leaves it again.
    const SurfaceRay ray = glsl::view_ray({11.0f / 64, 0.5f}, view_from(20, 180), 0.15f, 0.75f, finest);
    const std::vector<Solid> solids = walls.solids(ray);
    ASSERT_GE(solids.size(), 2u);
    MarchParams params = default_params(technique);
    params.refine_steps = 20;
    const double z = trace(technique, maps, ray, params).hit.height;
    EXPECT_LT(z, solids[0].leave - 0.1);
    double nearest = 1;
    for (const Solid& solid : solids) nearest = std::min(nearest, std::abs(z - solid.enter));
    EXPECT_LT(nearest, 1e-5) << "what it finds is a crossing all the same";
    EXPECT_NEAR(truth(maps.height, ray).height, solids[0].enter, 1e-6);
}

TEST(BinarySearch, halves_its_error_with_every_step_where_there_is_one_crossing) {
    const MapSet maps = baked_maps(HeightField(8, 8, 0.37f), 0.1f);
    const Technique& technique = *find_technique("binary_search");
    const SurfaceRay ray = glsl::view_ray({0.1f, 0.1f}, view_from(30, 70), 0.1f, 1.0f, finest);
    for (int k = 0; k <= 16; ++k) {
        MarchParams params = default_params(technique);
        params.refine_steps = k;
        const double late = 0.37 - static_cast<double>(trace(technique, maps, ray, params).hit.height);
        EXPECT_GE(late, -1e-6);
        EXPECT_LE(late, std::ldexp(1.0, -k) + 1e-6);
    }
}

}  // namespace
}  // namespace relievo::contract
