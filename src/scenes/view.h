// Where the camera stands: named elevations above the plane, or any number of degrees.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace relievo {

struct View {
    std::string id;
    double elevation_deg;        // of the line of sight above the polygon's plane, in (0, 90]
    double azimuth_deg = -68;    // of the eye around the polygon's normal, counter-clockwise from +u
};

std::span<const View> views();

// A named view, or "DEGREES" in [1, 90]; empty if it is neither.
std::optional<View> parse_view(std::string_view text);

}  // namespace relievo
