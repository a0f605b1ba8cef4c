// Distance mapping (Donnelly 2005): spheres that hold nothing carry the ray through empty space in few steps; the steps left over make
// those near the surface shorter, so that less is stepped over than by a linear search of as many.
#include "contract/random_fields.h"
#include "contract/trace.h"

namespace relievo::contract {
namespace {

// A field of lone spikes on a floor: a linear search of as many steps goes through them.
TEST(DistanceMapping, hits_spikes_that_a_linear_search_steps_over) {
    HeightField spikes(96, 96, 0.05f);
    std::mt19937 random(3);
    for (float& h : spikes.texels.texels)
        if (random() % 300 == 0) h = 1.0f;
    const float height_scale = 0.4f;
    const MapSet maps = baked_maps(spikes, height_scale);
    const auto missed = [&](const char* id) {
        const Technique& technique = *find_technique(id);
        MarchParams params = default_params(technique);
        params.max_steps = 32;
        int late = 0;
        for (const SurfaceRay& ray : random_rays(3000, 30, height_scale, 1.0f, 4)) {
            const SurfaceHit hit = trace(technique, maps, ray, params).hit;
            late += truth(maps.height, ray).height - static_cast<double>(hit.height) > 0.05 ? 1 : 0;
        }
        return late;
    };
    const int linear = missed("linear_search");
    EXPECT_GT(linear, 60);
    EXPECT_LT(missed("distance_mapping"), 0.7 * linear);
}

TEST(DistanceMapping, leaps_where_a_linear_search_walks) {
    const float height_scale = 0.2f;
    HeightField low(128, 128);
    for (int j = 0; j < 128; ++j)
        for (int i = 0; i < 128; ++i) low.texels(i, j) = 0.1f + 0.1f * static_cast<float>(std::sin(0.3 * i) * std::cos(0.2 * j));
    const MapSet maps = baked_maps(low, height_scale);
    double walked = 0;
    double leapt = 0;
    for (const SurfaceRay& ray : random_rays(500, 60, height_scale, 1.0f, 5)) {
        MarchParams params{};
        params.max_steps = 64;
        params.refine_steps = 4;
        walked += trace(*find_technique("relief_mapping"), maps, ray, params).fetches / 500.0;
        leapt += trace(*find_technique("distance_mapping"), maps, ray, params).fetches / 500.0;
    }
    EXPECT_LT(leapt, walked / 3);
}

}  // namespace
}  // namespace relievo::contract
