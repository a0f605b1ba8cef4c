// Contract 3: a search never fetches more than its row says, and whatever it is asked it ends with finite numbers.
#include "contract/random_fields.h"
#include "contract/trace.h"

namespace relievo::contract {
namespace {

// Vertical, grazing, along the axes and on their diagonals; from inside, just outside and far outside the first repeat.
std::vector<SurfaceRay> difficult_rays(float height_scale) {
    std::vector<SurfaceRay> rays;
    const float corners[] = {0.0f, 0.5f, -1e-6f, 1.000001f, -0.3f, 1e4f};
    for (const float zero_level : {0.0f, 0.5f, 1.0f}) {
        for (const double elevation : {90.0, 45.0, 0.1, 0.01}) {
            for (const double azimuth : {0.0, 45.0, 90.0, 180.0, 301.0}) {
                for (const float u : corners) {
                    for (const float v : {0.25f, -1e4f}) {
                        rays.push_back(glsl::view_ray({u, v}, view_from(elevation, azimuth), height_scale, zero_level, finest));
                    }
                }
            }
        }
        // Exactly along the axes and exactly vertical: not one component is rounding.
        for (const glsl::vec3 view : {glsl::vec3(0, 0, 1), glsl::vec3(0.6f, 0, 0.8f), glsl::vec3(-0.6f, 0, 0.8f), glsl::vec3(0, 0.6f, 0.8f),
                                      glsl::vec3(0, -0.6f, 0.8f), glsl::vec3(1, 0, 0), glsl::vec3(0, 1, 0)}) {
            for (const float u : corners) rays.push_back(glsl::view_ray({u, u}, view, height_scale, zero_level, 3.0f));
        }
    }
    // The same, as a light asks: ending above a point, and of no length at all.
    const std::size_t views = rays.size();
    for (std::size_t i = 0; i < views; i += 3) {
        const SurfaceHit point{.uv = rays[i].uv, .height = static_cast<float>(i % 5) / 4, .found = true};
        rays.push_back(glsl::light_ray(rays[i], point, rays[i].view, 0.002f));
    }
    return rays;
}

std::vector<MarchParams> settings(const Technique& technique) {
    std::vector<MarchParams> all{default_params(technique)};
    std::mt19937 random(5);
    for (int i = 0; i < 3; ++i) {
        MarchParams params = default_params(technique);
        for (const KnobDefault& d : technique.knobs) {
            const float t = i == 0 ? 0.0f : static_cast<float>(random() >> 8) / 16777216.0f;
            // The lowest setting, then random ones; a thousand steps for each of some thousand rays would only take time.
            d.knob->set(params, d.knob->min + (std::min(d.knob->max, 128.0f) - d.knob->min) * t * t);
        }
        all.push_back(params);
    }
    return all;
}

class Limits : public EveryTechnique {};

TEST_P(Limits, ends_and_stays_finite_within_its_fetches) {
    std::vector<HeightField> fields{rough_field(3), HeightField(1, 1, 0.5f), HeightField(7, 2, 0.0f), HeightField(4, 4, 1.0f)};
    HeightField spikes(16, 16);
    spikes.texels(3, 5) = 1;
    spikes.texels(0, 15) = 0.5f;
    fields.push_back(spikes);
    int most = 0;
    for (const float height_scale : {0.0f, 0.1f, 0.5f}) {
        const std::vector<SurfaceRay> rays = difficult_rays(height_scale);
        for (const HeightField& field : fields) {
            const MapSet maps = baked_maps(field, height_scale);
            const glsl::BoundMaps bound = declared_maps(technique(), maps);
            for (const MarchParams& params : settings(technique())) {
                const int allowed = technique().max_fetches(params);
                for (const SurfaceRay& ray : rays) {
                    const auto [hit, fetches] = trace(technique(), bound, ray, params);
                    most = std::max(most, fetches);
                    ASSERT_LE(fetches, allowed);
                    ASSERT_TRUE(std::isfinite(hit.uv.x) && std::isfinite(hit.uv.y) && std::isfinite(hit.height));
                    if (ray.z_end > 0.0f) continue;
                    ASSERT_TRUE(hit.found) << "a view ray meets the floor at the latest";
                    ASSERT_GE(hit.height, 0.0f);
                    ASSERT_LE(hit.height, 1.0f);
                }
            }
        }
    }
    EXPECT_EQ(most > 0, technique().maps.count > 0) << "a technique with maps fetches, one without does not";
}

// At the same knobs some ray needs close to all that is allowed: the bound is not padded.
TEST_P(Limits, comes_near_its_fetches) {
    MarchParams params = defaults();
    for (const KnobDefault& d : technique().knobs) d.knob->set(params, std::min(d.value, 8.0f));
    const MapSet maps = baked_maps(HeightField(rough_field(3)), 0.3f);
    int most = 0;
    for (const double elevation : {2.0, 20.0, 60.0})
        for (const SurfaceRay& ray : random_rays(300, elevation, 0.3f, 1.0f, 9)) most = std::max(most, trace(technique(), maps, ray, params).fetches);
    EXPECT_GE(most, technique().max_fetches(params) - 1);
}

FOR_EVERY_TECHNIQUE(Limits);

}  // namespace
}  // namespace relievo::contract
