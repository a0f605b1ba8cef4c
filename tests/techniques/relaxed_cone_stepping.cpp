// Relaxed cone stepping (Policarpo, Oliveira 2007): wider cones, fewer steps than Dummer's cones for the same field, and a leap that
// ends below the surface has entered it once.
#include "contract/profile.h"
#include "contract/random_fields.h"
#include "contract/trace.h"

namespace relievo::contract {
namespace {

struct Walk {
    double fetches = 0;
    double late = 0;  // share of hits more than a twentieth of the height late
};

Walk walk(const char* id, const MapSet& maps, double elevation, const MarchParams& params) {
    const Technique& technique = *find_technique(id);
    Walk result;
    const auto rays = random_rays(1500, elevation, 0.1f, 1.0f, 51);
    for (const SurfaceRay& ray : rays) {
        const auto [hit, fetches] = trace(technique, maps, ray, params);
        result.fetches += fetches / static_cast<double>(rays.size());
        result.late += (truth(maps.height, ray).height - static_cast<double>(hit.height) > 0.05 ? 1.0 : 0.0) / static_cast<double>(rays.size());
    }
    return result;
}

TEST(RelaxedConeStepping, takes_fewer_steps_than_empty_cones) {
    const MapSet maps = baked_maps(smooth_field(52), 0.1f);
    for (const double elevation : {15.0, 30.0, 60.0}) {
        MarchParams params = default_params(*find_technique("relaxed_cone_stepping"));
        params.max_steps = 512;
        params.refine_steps = 0;  // steps alone
        const Walk relaxed = walk("relaxed_cone_stepping", maps, elevation, params);
        const Walk empty = walk("cone_step_mapping", maps, elevation, params);
        EXPECT_LT(relaxed.fetches, 0.95 * empty.fetches) << elevation;
    }
}

TEST(RelaxedConeStepping, rarely_passes_what_it_hits_first) {
    const MapSet maps = baked_maps(smooth_field(53), 0.1f);
    for (const double elevation : {15.0, 45.0})
        EXPECT_LT(walk("relaxed_cone_stepping", maps, elevation, default_params(*find_technique("relaxed_cone_stepping"))).late, 0.002) << elevation;
}

// Over a texel's centre the cone is the map's own: a first leap from there never ends behind a whole ridge.
TEST(RelaxedConeStepping, does_not_leap_over_a_ridge) {
    const Profile ridge{.name = "ridge", .kinks = {{10, 0.1}, {20, 0.9}, {30, 0.1}}};
    const MapSet maps = baked_maps(ridge.field(), 0.1f);
    const Technique& technique = *find_technique("relaxed_cone_stepping");
    int through = 0;
    for (int i = 0; i < 64; ++i) {
        for (const double elevation : {5.0, 15.0, 40.0, 70.0}) {
            const glsl::vec3 view = view_from(elevation, 180);
            SurfaceRay ray = glsl::view_ray({0, 0.5f}, view, 0.1f, 1.0f, finest);
            ray.uv.x = (static_cast<float>(i) + 0.5f) / Profile::texels;  // enters over this texel's centre
            const auto solids = ridge.solids(ray);
            const double height = trace(technique, maps, ray, default_params(technique)).hit.height;
            if (solids.size() < 2) continue;
            ++through;
            EXPECT_GT(height, solids[0].leave - 1e-3) << elevation << ' ' << i;
        }
    }
    EXPECT_GT(through, 10);
}

}  // namespace
}  // namespace relievo::contract
