// Everything a person can turn in the window, as values: no window, no device.
#pragma once

#include "scenes/scene.h"
#include "scenes/view.h"
#include "techniques/modifiers.h"

#include <map>
#include <vector>

namespace relievo {

struct Controls {
    const Technique* technique = nullptr;
    std::map<const Knob*, float>
        turned;  // knobs that were moved; a knob means the same everywhere, so they hold for every technique
    float height_scale = 0;
    DrawOptions options{};
    bool split = false;
    float divider = 0.5f;  // share of the picture left of it: the technique; right of it: the reference

    View view;
    double zoom = 1;  // nearer by this factor than the view's own distance
    double light_azimuth_deg = 0;
    double light_elevation_deg = 0;

    // The view's camera and the stage's light; the rest is kept.
    void look_from(const View& from);
    void orbit(double azimuth_deg, double elevation_deg);
    void move_light(double azimuth_deg, double elevation_deg);
    void zoom_by(double notches);

    // The technique's defaults, with those of its knobs that were turned.
    MarchParams params() const;
    void turn(const Knob& knob, float value);

    Stage stage() const;
    // Two controls with equal numbers have the same reference picture.
    std::vector<double> scene_numbers() const;
};

// Those a window opens with.
Controls opening_controls(const Technique& technique, const View& view, float height_scale);

}  // namespace relievo
