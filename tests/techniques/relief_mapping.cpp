// Relief mapping (Policarpo, Oliveira, Comba 2005): after k bisections of a step the hit is late by less than step / 2^k.
#include "contract/profile.h"
#include "contract/trace.h"

namespace relievo::contract {
namespace {

TEST(ReliefMapping, is_late_by_less_than_the_step_over_two_to_the_bisections) {
    const Profile ramp{.name = "ramp", .kinks = {{4, 0.0}, {60, 1.0}}};
    const MapSet maps = baked_maps(ramp.field(), 0.1f);
    const Technique& technique = *find_technique("relief_mapping");
    for (const int steps : {4, 10}) {
        for (int k = 0; k <= 10; ++k) {
            MarchParams params = default_params(technique);
            params.max_steps = steps;
            params.refine_steps = k;
            double latest = 0;
            for (int i = 0; i < 64; ++i) {
                const float u = 0.3f + 0.4f * static_cast<float>(i) / 64;
                const SurfaceRay ray = glsl::view_ray({u, 0.5f}, view_from(50, i % 2 ? 0 : 180), 0.1f, 0.5f, finest);
                const double late = truth(maps.height, ray).height - static_cast<double>(trace(technique, maps, ray, params).hit.height);
                EXPECT_GE(late, -1e-5);
                latest = std::max(latest, late);
            }
            EXPECT_LE(latest, std::ldexp(1.0 / steps, -k) + 1e-5) << steps << " steps, " << k << " bisections";
            EXPECT_GE(latest, 0.5 * std::ldexp(1.0 / steps, -k) - 1e-5) << "the bound is not idle";
        }
    }
}

}  // namespace
}  // namespace relievo::contract
