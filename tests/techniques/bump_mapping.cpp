// Bump mapping (Blinn 1978): tilting the normal by the slopes of the heights gives the normal of the surface that the heights would
// make, whole on a plane and to first order on a curved base.
#include "contract/random_fields.h"
#include "contract/trace.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
namespace relievo::glsl {
namespace {
#include "shading/shading_normal.glsl"
}
}  // namespace relievo::glsl
#pragma GCC diagnostic pop

namespace relievo::contract {
namespace {

Vec3f bumped(const MapSet& maps, glsl::vec2 uv, float lod, float height_scale) {
    glsl::bound_maps = {.maps = &maps, .readable = MapFlags().set(index_of(Map::height))};
    return glsl::shading_normal(static_cast<int>(find_technique("bump_mapping")->shaded_by), uv, lod, height_scale);
}

float angle_deg(Vec3f a, Vec3f b) { return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi_v<float>; }

TEST(BumpMapping, has_a_planes_relief_normal) {
    // h = 0.2 + 0.6 u between texels 4 and 60 of 64: dh/du is known, and the normal is (-s dh/du, 0, 1).
    HeightField ramp(64, 8);
    for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 64; ++i) ramp.texels(i, j) = 0.2f + 0.6f * (static_cast<float>(i) + 0.5f) / 64;
    const MapSet maps = baked_maps(ramp, 0.4f);
    const Vec3f expected = normalize(Vec3f{-0.4f * 0.6f, 0, 1});
    for (const float u : {0.2f, 0.31f, 0.5f}) EXPECT_LT(angle_deg(bumped(maps, {u, 0.4f}, finest, 0.4f), expected), 0.01f);
}

TEST(BumpMapping, is_the_normal_map_at_texel_centres_without_having_one) {
    const float height_scale = 0.2f;
    const MapSet maps = baked_maps(rough_field(5), height_scale);
    float steepest = 0;
    for (int j = 0; j < maps.height.height(); ++j) {
        for (int i = 0; i < maps.height.width(); ++i) {
            const glsl::vec2 uv{(static_cast<float>(i) + 0.5f) / static_cast<float>(maps.height.width()),
                                (static_cast<float>(j) + 0.5f) / static_cast<float>(maps.height.height())};
            const float* n = maps.normal[0].at(i, j);
            const Vec3f normal{n[0], n[1], n[2]};
            ASSERT_LT(angle_deg(bumped(maps, uv, finest, height_scale), normal), 0.05f) << i << ' ' << j;
            steepest = std::max(steepest, angle_deg(normal, {0, 0, 1}));
        }
    }
    EXPECT_GT(steepest, 60) << "the field must have flanks for this to say anything";
}

// A pixel wider than a texel sees the mean slope across it: seen from afar, noise on every texel is level ground.
TEST(BumpMapping, averages_over_a_wide_pixel) {
    const MapSet maps = baked_maps(rough_field(5), 0.2f);
    double near = 0;
    double far = 0;
    for (int i = 0; i < 200; ++i) {
        const glsl::vec2 uv{0.005f * static_cast<float>(i), 0.37f};
        near += angle_deg(bumped(maps, uv, finest, 0.2f), {0, 0, 1}) / 200;
        far += angle_deg(bumped(maps, uv, -1, 0.2f), {0, 0, 1}) / 200;  // a pixel of half a repeat
    }
    EXPECT_LT(far, 0.25 * near);
}

// A cylinder of radius 1 with waves of amplitude a: the error against the true normal, by differences in double, falls with a^2.
TEST(BumpMapping, is_first_order_on_a_curved_base) {
    const auto worst = [](double amplitude) {
        const auto bump = [&](double u, double v) { return amplitude * std::sin(5 * u) * std::cos(3 * v); };
        const auto moved = [&](double u, double v) {
            const double r = 1 + bump(u, v);
            return Vec3d{r * std::cos(u), r * std::sin(u), v};
        };
        double most = 0;
        for (double u = 0.1; u < 6; u += 0.37) {
            for (double v = 0; v < 2; v += 0.23) {
                const double e = 1e-4;
                const Vec3d exact = normalize(cross(moved(u + e, v) - moved(u - e, v), moved(u, v + e) - moved(u, v - e)));
                const Vec3d blinn{glsl::bump_normal({static_cast<float>(-std::sin(u)), static_cast<float>(std::cos(u)), 0}, {0, 0, 1},
                                                    {static_cast<float>(5 * amplitude * std::cos(5 * u) * std::cos(3 * v)),
                                                     static_cast<float>(-3 * amplitude * std::sin(5 * u) * std::sin(3 * v))})};
                most = std::max(most, length(blinn - exact));
            }
        }
        return most;
    };
    EXPECT_GT(worst(0.04), 1e-3) << "the neglected term is there";
    EXPECT_LT(worst(0.02), 0.3 * worst(0.04));
    EXPECT_LT(worst(0.01), 0.3 * worst(0.02));
}

}  // namespace
}  // namespace relievo::contract
