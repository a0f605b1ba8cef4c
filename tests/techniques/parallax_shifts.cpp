// The three single shifts: Kaneko et al. 2001 take the height under the ray for a level surface, Welsh 2004 drops the division by
// the view's cosine so that a shift is never longer than the relief is high, Premecz 2006 weighs that by the slope.
#include "contract/random_fields.h"
#include "contract/trace.h"

namespace relievo::contract {
namespace {

constexpr float height_scale = 0.08f;

glsl::vec2 shift_of(const char* id, const MapSet& maps, const SurfaceRay& ray) {
    const Technique& technique = *find_technique(id);
    return trace(technique, maps, ray, default_params(technique)).hit.uv - ray.uv;
}

TEST(ParallaxMapping, shifts_without_bound_where_offset_limiting_stays_within_the_relief) {
    const MapSet maps = baked_maps(rough_field(4), height_scale);
    for (const double elevation : {1.0, 10.0, 45.0, 89.0}) {
        float longest = 0;
        for (const float zero_level : {0.0f, 0.5f, 1.0f}) {
            const float reach = std::max(zero_level, 1 - zero_level);
            for (const SurfaceRay& ray : random_rays(300, elevation, height_scale, zero_level, 2)) {
                EXPECT_LE(length(shift_of("parallax_offset_limiting", maps, ray)), height_scale * reach * 1.00001f);
                longest = std::max(longest, length(shift_of("parallax_mapping", maps, ray)));
            }
        }
        if (elevation < 30) {
            EXPECT_GT(longest, height_scale / std::tan(elevation * std::numbers::pi / 180) * 0.8);
        }
    }
}

TEST(ParallaxOffsetLimiting, is_parallax_mapping_times_the_cosine_of_the_view) {
    const MapSet maps = baked_maps(rough_field(4), height_scale);
    for (const SurfaceRay& ray : random_rays(300, 35, height_scale, 0.3f, 3)) {
        const glsl::vec2 expected = ray.view.z * shift_of("parallax_mapping", maps, ray);
        EXPECT_LT(length(shift_of("parallax_offset_limiting", maps, ray) - expected), 1e-6f);
    }
}

TEST(ParallaxSlope, is_offset_limiting_times_the_normals_height) {
    const float tall = 0.3f;
    const MapSet maps = baked_maps(rough_field(4), tall);
    bool steep = false;
    for (const SurfaceRay& ray : random_rays(300, 35, tall, 0.3f, 3)) {
        glsl::bound_maps = {.maps = &maps, .readable = MapFlags().set()};
        const float slope = glsl::normal_at(ray.uv, ray.lod).z;
        steep = steep || slope < 0.6f;
        const glsl::vec2 expected = slope * shift_of("parallax_offset_limiting", maps, ray);
        EXPECT_LT(length(shift_of("parallax_slope", maps, ray) - expected), 1e-6f);
    }
    EXPECT_TRUE(steep) << "the field must have flanks for this to say anything";
}

}  // namespace
}  // namespace relievo::contract
