// Contact refinement (Riccardi 2019): the precision of many short steps for the price of few, and the first of several crossings
// inside the long step that met the surface.
#include "contract/profile.h"
#include "contract/trace.h"

namespace relievo::contract {
namespace {

SurfaceHit hit_of(const char* id, const MapSet& maps, const SurfaceRay& ray, int steps, int refinements, int parts, int* fetches = nullptr) {
    const Technique& technique = *find_technique(id);
    MarchParams params = default_params(technique);
    params.max_steps = steps;
    params.refine_steps = refinements;
    params.contact_steps = parts;
    const Traced traced = trace(technique, maps, ray, params);
    if (fetches != nullptr) *fetches = std::max(*fetches, traced.fetches);
    return traced.hit;
}

// On a ramp, which a ray meets once, the hit is that of a linear search whose every step was as short as the shortest.
TEST(ContactRefinement, is_the_linear_search_in_its_shortest_steps) {
    const Profile ramp{.name = "ramp", .kinks = {{4, 0.0}, {60, 1.0}}};
    const MapSet maps = baked_maps(ramp.field(), 0.1f);
    int refined = 0;
    int linear = 0;
    for (int i = 0; i < 64; ++i) {
        const SurfaceRay ray = glsl::view_ray({0.3f + 0.4f * static_cast<float>(i) / 64, 0.5f}, view_from(50, i % 2 ? 0 : 180), 0.1f, 0.5f, finest);
        const float here = hit_of("contact_refinement", maps, ray, 8, 2, 4, &refined).height;
        const double true_height = truth(maps.height, ray).height;
        EXPECT_LE(here, true_height + 1e-6);
        EXPECT_GE(here, true_height - 1.0 / 128 - 1e-6);
        // linear_search looks at the beginnings of its steps: one more of them looks at 1/128, 2/128 ... too.
        EXPECT_NEAR(here, hit_of("linear_search", maps, ray, 128, 0, 1, &linear).height, 1e-6);
    }
    EXPECT_LE(refined, 8 + 2 * 3);
    EXPECT_GT(linear, 60);
}

// A ray that goes through a ridge and into the ground within one long step: bisection may take either, the shorter steps come from the
// eye's side.
TEST(ContactRefinement, finds_the_first_of_three_crossings_where_bisection_does_not) {
    // All relief lies in the lower of two steps.
    const Profile ridges{.name = "ridges", .kinks = {{10, 0.1}, {14, 0.45}, {18, 0.1}, {40, 0.1}, {44, 0.45}, {48, 0.1}}};
    const MapSet maps = baked_maps(ridges.field(), 0.2f);
    const double shortest = 0.5 / 16;
    int refined_late = 0;
    int bisected_late = 0;
    int rays = 0;
    for (int i = 0; i < 400; ++i) {
        const SurfaceRay ray = glsl::view_ray({(static_cast<float>(i) + 0.5f) / 400, 0.5f}, view_from(30, 0), 0.2f, 1.0f, finest);
        const auto solids = ridges.solids(ray);
        if (solids.size() < 2) continue;
        ++rays;
        const auto late = [&](const SurfaceHit& hit) { return solids[0].enter - static_cast<double>(hit.height) > shortest + 1e-5 ? 1 : 0; };
        refined_late += late(hit_of("contact_refinement", maps, ray, 2, 1, 16));
        bisected_late += late(hit_of("relief_mapping", maps, ray, 2, 15, 2));
    }
    ASSERT_GT(rays, 40);
    EXPECT_GT(bisected_late, 10);
    EXPECT_LT(refined_late, bisected_late / 2);
}

}  // namespace
}  // namespace relievo::contract
