// The colours of a drawing's roles.
#pragma once

#include "core/legend.h"
#include "figure/drawing.h"

#include <string_view>

namespace relievo {

struct InkColour {
    std::string_view id;  // class name in SVG
    Rgb8 light;           // on white paper
    Rgb8 dark;            // on dark paper
};

const InkColour& ink_colour(Ink ink);

}  // namespace relievo
