// A colour as style sheets and results.json write it.
#pragma once

#include "core/legend.h"

#include <cstdio>
#include <string>

namespace relievo {

inline std::string css_colour(const Rgb8& colour) {
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", colour[0], colour[1], colour[2]);
    return text;
}

}  // namespace relievo
