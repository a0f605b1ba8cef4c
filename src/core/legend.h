// What the colours of a picture mean, as data: the stage that colours the picture makes it, the report draws it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace relievo {

using Rgb8 = std::array<std::uint8_t, 3>;  // sRGB-encoded

// A point of the colour bar. Between stops sRGB-encoded values are interpolated linearly (as a CSS linear-gradient does); two
// stops at one position are a hard edge.
struct LegendStop {
    double position = 0;  // along the bar, 0 left to 1 right, never falling
    double value = 0;     // in the legend's unit
    Rgb8 colour{};
    std::string label;    // empty: no tick here
};

// A colour with one meaning, beside the bar.
struct LegendKey {
    Rgb8 colour{};
    std::string label;
};

struct Legend {
    std::string title;
    std::string unit;
    std::string low_end, high_end;  // what the ends of the bar mean
    std::vector<LegendStop> stops{};
    std::vector<LegendKey> keys{};
};

}  // namespace relievo
