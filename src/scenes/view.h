// Where the camera stands: named elevations above the plane, or any number of degrees; nearer or farther than is usual.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace relievo {

struct View {
    std::string id;
    double elevation_deg;        // of the line of sight above the polygon's plane, in (0, 90]; below it, from behind, in [-90, 0)
    double azimuth_deg = -68;    // of the eye around the polygon's normal, counter-clockwise from +u
    double distance = 1;         // of the eye, over the usual one; the base is as many times wider and fills the picture as it does there

    bool from_behind() const { return elevation_deg < 0; }
};

std::span<const View> views();

// A named view or "DEGREES" in [1, 90] or, from behind, in [-90, -1], and after an @ how many times as far away as usual, in [0.1, 100]: "grazing@4", "20@0.5". Empty
// if it is none of these.
std::optional<View> parse_view(std::string_view text);

}  // namespace relievo
