// Iterative parallax mapping (Premecz 2006) converges on smooth slopes: on a plane the error shrinks by the same factor every time.
// The form that adds the height without subtracting the ray's own never settles.
#include "contract/profile.h"
#include "contract/random_fields.h"
#include "contract/trace.h"

namespace relievo::contract {
namespace {

constexpr float height_scale = 0.08f;

SurfaceHit after(int iterations, const MapSet& maps, const SurfaceRay& ray) {
    return trace(*find_technique("parallax_iterative"), maps, ray, {.max_steps = 1, .min_steps = 1, .refine_steps = 0, .iterations = iterations, .tolerance = 0})
        .hit;
}

TEST(ParallaxIterative, error_on_a_plane_shrinks_by_a_constant_factor) {
    const Profile plane{.name = "plane", .kinks = {{4, 0.2}, {60, 0.8}}};
    const MapSet maps = baked_maps(plane.field(), height_scale);
    const double slope = 0.6 / 56 * Profile::texels;  // height per u
    const double n_z = 1 / std::hypot(1.0, height_scale * slope);
    for (const double azimuth : {0.0, 180.0, 60.0}) {
        const SurfaceRay ray = glsl::view_ray({0.5f, 0.5f}, view_from(40, azimuth), height_scale, 0.5f, finest);
        const double factor = 1 - n_z * ray.view.z * (1 - slope * ray.uv_per_height.x);
        double before = ray.zero_level - truth(maps.height, ray).height;
        for (int k = 1; k <= 6; ++k) {
            const double error = after(k, maps, ray).height - truth(maps.height, ray).height;
            EXPECT_NEAR(error, before * factor, 2e-5) << "azimuth " << azimuth << ", iteration " << k;
            before = error;
        }
    }
}

TEST(ParallaxIterative, arrives_on_smooth_ground_where_the_drifting_form_does_not) {
    const MapSet maps = baked_maps(smooth_field(5), height_scale);
    double ours = 0;
    double drifting = 0;
    const auto rays = random_rays(300, 45, height_scale, 1.0f, 6);
    for (const SurfaceRay& ray : rays) {
        const Vec2d expected = truth(maps.height, ray).uv;
        ours = std::max(ours, length(Vec2d(after(32, maps, ray).uv) - expected));
        // (u, v) <- (u, v) + n_z (s h + b) p_xy, as one often sees it written.
        glsl::bound_maps = {.maps = &maps, .readable = MapFlags().set()};
        glsl::vec2 uv = ray.uv;
        for (int k = 0; k < 32; ++k)
            uv += glsl::normal_at(uv, ray.lod).z * (glsl::height_at(uv) - ray.zero_level) * height_scale * glsl::vec2(ray.view.x, ray.view.y);
        drifting += length(Vec2d(uv) - expected) / static_cast<double>(rays.size());
    }
    EXPECT_LT(ours, 1e-4);
    EXPECT_GT(drifting, 5 * static_cast<double>(height_scale));
}

}  // namespace
}  // namespace relievo::contract
