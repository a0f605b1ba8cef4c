#include "scenes/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relievo {

namespace {

constexpr Scene scene_table[] = {
    {.id = "bricks", .title = "Brick wall", .summary = "steep joints: corners are cut and terraces show", .height_scale = 0.05f},
    {.id = "cobbles", .title = "Cobblestones", .summary = "round stones that hide each other: one stone is painted on the next", .height_scale = 0.10f},
    {.id = "spikes", .title = "Thin spikes", .summary = "features thinner than a step: equal steps miss them, cones creep", .height_scale = 0.12f},
    {.id = "engraving", .title = "Engraved stone", .summary = "fine grooves with sheer walls: sub-texel hits and shadow lines", .height_scale = 0.04f},
    {.id = "dunes", .title = "Dunes", .summary = "smooth long waves: where cheap parallax is at its best, until the view is grazing", .height_scale = 0.14f},
};

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180; }

}  // namespace

std::span<const Scene> scenes() { return scene_table; }

const Scene* find_scene(std::string_view id) {
    const auto it = std::ranges::find(scene_table, id, &Scene::id);
    return it == std::end(scene_table) ? nullptr : it;
}

Stage stage_for(const View& view) {
    Stage stage;
    const double e = radians(std::abs(view.elevation_deg));
    const double a = radians(view.azimuth_deg);
    // Near enough that the square fills the frame, about two and a half repeats wide; farther when seen from above, where a repeat
    // is not foreshortened. At grazing views the square's far edge stays in sight: there a flat base betrays itself.
    const double distance = (1.75 + 0.75 * std::sin(e)) * view.distance;
    stage.camera.eye = Vec3d{std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)} * distance;
    // Aimed a little short of the centre, so that the horizon stays in the upper quarter.
    stage.camera.target = Vec3d{std::cos(a), std::sin(a), 0} * (0.25 * std::cos(e) * view.distance);
    stage.camera.fov_y_rad = radians(32);
    stage.camera.from_behind = view.from_behind();
    stage.base.periods *= static_cast<float>(view.distance);

    // 32 degrees above the surface: low enough that relief reads, high enough that shadows do not swallow the joints.
    const double key_e = radians(32);
    const double key_a = radians(35);
    Light key;
    key.position = Vec3f{static_cast<float>(std::cos(key_e) * std::cos(key_a)), static_cast<float>(std::cos(key_e) * std::sin(key_a)),
                         static_cast<float>(std::sin(key_e))};
    key.colour = {1.55f, 1.42f, 1.22f};
    Light fill;
    fill.position = normalize(Vec3f{-0.6f, -0.5f, 0.75f});
    fill.colour = {0.16f, 0.20f, 0.27f};
    stage.lighting.lights = {key, fill};
    return stage;
}

RayField quad_rays(const Stage& stage, int width, int height, Vec2d offset) {
    RayField rays(width, height);
    const double half = stage.base.periods / 2;
    const auto meet = [&](Vec2d pixel, Vec3d& direction) {
        direction = stage.camera.ray(pixel, width, height);
        const double t = -stage.camera.eye.z / direction.z;
        return Vec2d{stage.camera.eye.x + t * direction.x + half, stage.camera.eye.y + t * direction.y + half};
    };
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const Vec2d pixel{x + 0.5 + offset.x, y + 0.5 + offset.y};
            Vec3d d;
            const Vec2d uv = meet(pixel, d);
            if (d.z >= 0 || uv.x < 0 || uv.y < 0 || uv.x > stage.base.periods || uv.y > stage.base.periods) continue;
            Vec3d unused;
            const Vec2d du = meet(pixel + Vec2d{1, 0}, unused) - uv;
            const Vec2d dv = meet(pixel + Vec2d{0, 1}, unused) - uv;
            rays.coverage(x, y) = static_cast<std::uint8_t>(Coverage::hit);
            rays.uv(x, y, 0) = static_cast<float>(uv.x);
            rays.uv(x, y, 1) = static_cast<float>(uv.y);
            rays.view(x, y, 0) = static_cast<float>(-d.x);
            rays.view(x, y, 1) = static_cast<float>(-d.y);
            rays.view(x, y, 2) = static_cast<float>(-d.z);
            rays.lod(x, y) = static_cast<float>(std::log2(std::max(length(du), length(dv))));
        }
    }
    return rays;
}

}  // namespace relievo
