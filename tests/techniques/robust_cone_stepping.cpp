// Robust cone step mapping (Ban, Valasek 2024): cones over the surface itself and a shortest step to the next cell's wall miss less and
// arrive sooner than Dummer's blended cones.
#include "contract/random_fields.h"
#include "contract/trace.h"

namespace relievo::contract {
namespace {

// Share of hits off by more than half a texel, either way.
double wrong(const char* id, const MapSet& maps, double elevation, int max_steps) {
    const Technique& technique = *find_technique(id);
    MarchParams params = default_params(technique);
    params.max_steps = max_steps;
    const auto rays = random_rays(2000, elevation, 0.1f, 1.0f, 61);
    double off = 0;
    for (const SurfaceRay& ray : rays) {
        const Vec2d error = Vec2d(trace(technique, maps, ray, params).hit.uv) - truth(maps.height, ray).uv;
        off += length(error * Vec2d{static_cast<double>(maps.height.width()), static_cast<double>(maps.height.height())}) > 0.5 ? 1 : 0;
    }
    return off / static_cast<double>(rays.size());
}

TEST(RobustConeStepping, is_wrong_less_often_than_blended_cones) {
    const MapSet maps = baked_maps(rough_field(62), 0.1f);
    for (const double elevation : {15.0, 30.0}) {
        const double blended = wrong("cone_step_mapping", maps, elevation, 256);
        EXPECT_GT(blended, 0.005);
        EXPECT_LT(wrong("robust_cone_stepping", maps, elevation, 256), 0.5 * blended) << elevation;
    }
}

// Spikes of one texel make every cone narrow. Steps to the next wall end at the far side in as many steps as there are cells.
TEST(RobustConeStepping, does_not_creep_beside_spikes) {
    HeightField spikes(64, 64);
    for (int j = 0; j < 64; j += 3)
        for (int i = 0; i < 64; i += 3) spikes.texels(i, j) = 1.0f;
    const MapSet maps = baked_maps(spikes, 0.1f);
    const Technique& technique = *find_technique("robust_cone_stepping");
    MarchParams params = default_params(technique);
    params.max_steps = 1000;
    for (const SurfaceRay& ray : random_rays(500, 40, 0.1f, 1.0f, 63)) {
        const double cells = 64 * (std::abs(static_cast<double>(ray.uv_per_height.x)) + std::abs(static_cast<double>(ray.uv_per_height.y)));
        EXPECT_LE(trace(technique, maps, ray, params).fetches, 2 * (cells + 3) + params.refine_steps);
    }
}

}  // namespace
}  // namespace relievo::contract
