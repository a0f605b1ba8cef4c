// Averaged parallax: as its shift is not divided by the view's cosine, it looks for where a steeper ray meets the relief. Each
// repetition halves what is left, so three make it more precise than one on gentle relief; "on sharp relief it easily gives wrong
// results" beyond some scale, for nothing tells it what is hidden.
#include "contract/profile.h"
#include "contract/random_fields.h"
#include "contract/trace.h"

namespace relievo::contract {
namespace {

// Mean distance to where the steeper ray meets the field, in texels of its width.
double mean_error(const HeightField& field, float height_scale, int iterations) {
    const MapSet maps = baked_maps(field, height_scale);
    const Technique& technique = *find_technique("parallax_averaged");
    MarchParams params = default_params(technique);
    params.iterations = iterations;
    double sum = 0;
    const auto rays = random_rays(2000, 45, height_scale, 0.5f, 31);
    for (const SurfaceRay& ray : rays) {
        SurfaceRay steeper = ray;
        steeper.uv_per_height = height_scale * glsl::vec2(ray.view.x, ray.view.y);
        sum += length(Vec2d(trace(technique, maps, ray, params).hit.uv) - truth(field, steeper).uv) * field.width();
    }
    return sum / static_cast<double>(rays.size());
}

TEST(ParallaxAveraged, is_more_precise_the_more_often_it_averages) {
    const HeightField field = smooth_field(32);
    const double one = mean_error(field, 0.1f, 1);
    const double three = mean_error(field, 0.1f, 3);
    EXPECT_LT(three, 0.5 * one);
}

TEST(ParallaxAveraged, works_up_to_a_scale_only) {
    const HeightField field = rough_field(33);
    // In units of the relief's own amplitude the error grows: the slopes outrun the halving.
    EXPECT_GT(mean_error(field, 0.4f, 3) / 0.4, 1.5 * mean_error(field, 0.05f, 3) / 0.05);
}

TEST(ParallaxAveraged, halves_the_way_to_where_it_settles) {
    // On a ramp of slope a the shift leads from H to a height that lies on a line: what is left shrinks by (1 + a s) / 2 each time.
    const Profile ramp{.name = "ramp", .kinks = {{4, 0.0}, {60, 1.0}}};
    const float s = 0.2f;
    const MapSet maps = baked_maps(ramp.field(), s);
    const Technique& technique = *find_technique("parallax_averaged");
    const SurfaceRay ray = glsl::view_ray({0.5f, 0.4f}, view_from(50, 180), s, 0.2f, finest);
    const auto height = [&](int iterations) {
        MarchParams params = default_params(technique);
        params.iterations = iterations;
        return trace(technique, maps, ray, params).hit.height;
    };
    const float slope = 64.0f / 56.0f * s * ray.view.x;
    const float rate = 0.5f * (1 + slope);
    const float settled = height(40);
    for (int k = 1; k < 6; ++k) EXPECT_NEAR((height(k + 1) - settled) / (height(k) - settled), rate, 1e-3f) << k;
}

}  // namespace
}  // namespace relievo::contract
