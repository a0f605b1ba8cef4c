#include "viewer/controls.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relievo {

namespace {

// Below one degree the quad is a line; straight above the picture's up direction flips.
constexpr double lowest_eye_deg = 1;
constexpr double highest_eye_deg = 89.9;
// A light in the plane lights nothing; straight above, its azimuth would be lost.
constexpr double lowest_light_deg = 3;
constexpr double highest_light_deg = 89;
constexpr double zoom_per_notch = 1.1;
constexpr double least_zoom = 0.25;  // the whole quad is small in the frame
constexpr double most_zoom = 12;     // a texel of a 512 map is some pixels wide

constexpr double degrees_per_radian = 180 / std::numbers::pi;

double wrapped_deg(double degrees) { return std::remainder(degrees, 360.0); }

}  // namespace

void Controls::look_from(const View& from) {
    view = from;
    zoom = 1;
}

void Controls::orbit(double azimuth_deg, double elevation_deg) {
    view.azimuth_deg = wrapped_deg(view.azimuth_deg + azimuth_deg);
    view.elevation_deg = std::clamp(view.elevation_deg + elevation_deg, lowest_eye_deg, highest_eye_deg);
    view.id.clear();
}

void Controls::move_light(double azimuth_deg, double elevation_deg) {
    light_azimuth_deg = wrapped_deg(light_azimuth_deg + azimuth_deg);
    light_elevation_deg = std::clamp(light_elevation_deg + elevation_deg, lowest_light_deg, highest_light_deg);
}

void Controls::zoom_by(double notches) { zoom = std::clamp(zoom * std::pow(zoom_per_notch, notches), least_zoom, most_zoom); }

MarchParams Controls::params() const {
    MarchParams params = default_params(*technique);
    for (const KnobDefault& d : technique->knobs)
        if (const auto it = turned.find(d.knob); it != turned.end()) d.knob->set(params, it->second);
    return params;
}

void Controls::turn(const Knob& knob, float value) { turned[&knob] = value; }

Stage Controls::stage() const {
    Stage stage = stage_for(view);
    Camera& camera = stage.camera;
    camera.eye = camera.target + (camera.eye - camera.target) * (1 / zoom);
    const double a = light_azimuth_deg / degrees_per_radian;
    const double e = light_elevation_deg / degrees_per_radian;
    stage.lighting.lights[0].position = Vec3f(Vec3d{std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)});
    return stage;
}

std::vector<double> Controls::scene_numbers() const {
    std::vector<double> numbers{view.elevation_deg, view.azimuth_deg, zoom, light_azimuth_deg, light_elevation_deg, height_scale};
    for (const Modifier& m : modifiers()) numbers.push_back(options.*m.choice);
    for (const ModifierNumber& n : modifier_numbers()) numbers.push_back(n.get(options));
    return numbers;
}

Controls opening_controls(const Technique& technique, const View& view, float height_scale) {
    Controls controls;
    controls.technique = &technique;
    controls.height_scale = height_scale;
    controls.view = view;
    const Vec3d light(stage_for(view).lighting.lights[0].position);
    controls.light_azimuth_deg = std::atan2(light.y, light.x) * degrees_per_radian;
    controls.light_elevation_deg = std::asin(std::clamp(light.z, -1.0, 1.0)) * degrees_per_radian;
    return controls;
}

}  // namespace relievo
