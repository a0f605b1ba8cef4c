// What a person turns, without a window.
#include "viewer/controls.h"

#include "techniques/catalogue.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relievo {
namespace {

Controls opened() { return opening_controls(*find_technique("relief_mapping"), views()[1], 0.1f); }

TEST(controls, open_on_the_stage_of_the_pictures) {
    for (const View& view : views()) {
        const Stage want = stage_for(view);
        const Stage got = opening_controls(techniques().front(), view, 0.1f).stage();
        EXPECT_EQ(got.camera.eye, want.camera.eye);
        EXPECT_EQ(got.camera.target, want.camera.target);
        ASSERT_EQ(got.lighting.lights.size(), want.lighting.lights.size());
        const Vec3f off = got.lighting.lights[0].position - want.lighting.lights[0].position;
        EXPECT_LT(length(off), 1e-6f) << view.id;
        EXPECT_EQ(got.lighting.lights[1].position, want.lighting.lights[1].position);
    }
}

TEST(controls, orbit_keeps_the_distance_and_stays_above_the_plane) {
    Controls c = opened();
    c.orbit(30, 0);
    const double radius = length(c.stage().camera.eye);
    c.orbit(200, 0);
    EXPECT_NEAR(length(c.stage().camera.eye), radius, 1e-12);
    EXPECT_LE(std::abs(c.view.azimuth_deg), 180);
    for (const double down : {-500.0, 500.0}) {
        c.orbit(0, down);
        const Camera camera = c.stage().camera;
        EXPECT_GT(camera.eye.z, 0);
        EXPECT_TRUE(std::isfinite(camera.axes().right.x));
        EXPECT_GE(c.view.elevation_deg, 1);
        EXPECT_LT(c.view.elevation_deg, 90);
    }
}

TEST(controls, zoom_moves_the_eye_along_the_line_of_sight) {
    Controls c = opened();
    const Camera before = c.stage().camera;
    c.zoom_by(3);
    const Camera after = c.stage().camera;
    EXPECT_EQ(after.target, before.target);
    EXPECT_LT(length(after.eye - after.target), length(before.eye - before.target));
    EXPECT_LT(length(cross(after.eye - after.target, before.eye - before.target)), 1e-12);
    c.zoom_by(-3);
    EXPECT_NEAR(length(c.stage().camera.eye - before.eye), 0, 1e-12);
    for (const double notches : {-1000.0, 1000.0}) {
        c.zoom_by(notches);
        EXPECT_GT(c.stage().camera.eye.z, 1e-2);  // well outside of the nearest depth that is drawn
    }
}

TEST(controls, the_light_stays_a_unit_vector_above_the_plane) {
    Controls c = opened();
    for (const double up : {-300.0, 300.0}) {
        c.move_light(77, up);
        const Vec3f light = c.stage().lighting.lights[0].position;
        EXPECT_NEAR(length(light), 1, 1e-6);
        EXPECT_GT(light.z, 0.04f);
    }
}

TEST(controls, a_turned_knob_holds_for_every_technique_that_declares_it) {
    Controls c = opened();
    EXPECT_EQ(c.params().max_steps, 30);
    c.turn(knob::max_steps, 17);
    c.technique = find_technique("linear_search");
    EXPECT_EQ(c.params().max_steps, 17);
    c.technique = find_technique("texture_mapping");
    for (const Knob* k : knobs)
        EXPECT_EQ(k->get(c.params()), k->get(default_params(*c.technique))) << k->id << " is undeclared, so it is not turned";
    c.technique = find_technique("parallax_iterative");
    EXPECT_EQ(c.params().iterations, 4) << "what was not turned is the catalogue's";
    c.turn(knob::iterations, 1e9f);
    EXPECT_EQ(c.params().iterations, static_cast<int>(knob::iterations.max));
}

TEST(controls, everything_that_changes_the_reference_changes_its_numbers) {
    const Controls start = opened();
    const auto changed = [&](auto&& f) {
        Controls c = start;
        f(c);
        return c.scene_numbers() != start.scene_numbers();
    };
    EXPECT_TRUE(changed([](Controls& c) { c.orbit(1, 0); }));
    EXPECT_TRUE(changed([](Controls& c) { c.orbit(0, 1); }));
    EXPECT_TRUE(changed([](Controls& c) { c.move_light(1, 0); }));
    EXPECT_TRUE(changed([](Controls& c) { c.move_light(0, 1); }));
    EXPECT_TRUE(changed([](Controls& c) { c.zoom_by(1); }));
    EXPECT_TRUE(changed([](Controls& c) { c.height_scale *= 2; }));
    EXPECT_TRUE(changed([](Controls& c) { c.options.shadow = glsl::shadow_none; }));
    EXPECT_FALSE(changed([](Controls& c) { c.technique = &techniques().front(); }));
    EXPECT_FALSE(changed([](Controls& c) { c.turn(knob::max_steps, 3); }));
}

}  // namespace
}  // namespace relievo
