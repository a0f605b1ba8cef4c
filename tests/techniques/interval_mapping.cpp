// Interval mapping (Risser, Shah, Pattanaik 2005): knowing how far the ends of the interval are from the surface beats halving it
// blindly, and needs few steps where the relief is smooth.
#include "contract/profile.h"
#include "contract/random_fields.h"
#include "contract/trace.h"

namespace relievo::contract {
namespace {

double mean_height_error(const char* id, const MapSet& maps, int steps, int refinements) {
    const Technique& technique = *find_technique(id);
    MarchParams params = default_params(technique);
    params.max_steps = steps;
    params.refine_steps = refinements;
    std::vector<double> off;
    for (const SurfaceRay& ray : random_rays(2000, 40, 0.1f, 1.0f, 41))
        off.push_back(std::abs(static_cast<double>(trace(technique, maps, ray, params).hit.height) - truth(maps.height, ray).height));
    std::ranges::sort(off);
    // The tenth that missed the first hit in the linear search is not what is compared.
    double sum = 0;
    for (std::size_t i = 0; i < off.size() * 9 / 10; ++i) sum += off[i];
    return sum / static_cast<double>(off.size());
}

TEST(IntervalMapping, finds_a_plane_at_once) {
    const Profile ramp{.name = "ramp", .kinks = {{4, 0.0}, {60, 1.0}}};
    const MapSet maps = baked_maps(ramp.field(), 0.1f);
    const Technique& technique = *find_technique("interval_mapping");
    MarchParams params = default_params(technique);
    params.max_steps = 3;
    params.refine_steps = 1;
    for (int i = 0; i < 64; ++i) {
        const SurfaceRay ray = glsl::view_ray({0.3f + 0.4f * static_cast<float>(i) / 64, 0.5f}, view_from(50, i % 2 ? 0 : 180), 0.1f, 0.5f, finest);
        EXPECT_NEAR(trace(technique, maps, ray, params).hit.height, truth(maps.height, ray).height, 2e-6);
    }
}

TEST(IntervalMapping, beats_as_many_bisections_on_smooth_relief) {
    const MapSet maps = baked_maps(smooth_field(42), 0.1f);
    for (const int refinements : {1, 2, 3}) {
        const double secants = mean_height_error("interval_mapping", maps, 14, refinements);
        const double halvings = mean_height_error("relief_mapping", maps, 14, refinements);
        EXPECT_LT(secants, 0.3 * halvings) << refinements;
    }
}

TEST(IntervalMapping, needs_two_secants_for_what_bisection_needs_six) {
    const MapSet maps = baked_maps(smooth_field(42), 0.1f);
    EXPECT_LT(mean_height_error("interval_mapping", maps, 14, 2), mean_height_error("relief_mapping", maps, 14, 6));
}

}  // namespace
}  // namespace relievo::contract
