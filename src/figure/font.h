// The letters of drawings: DejaVu Sans, inside the program, so that text has the same size and shape everywhere.
#pragma once

#include "core/vec.h"

#include <string_view>
#include <vector>

namespace relievo {

// Width in pixels of a line of UTF-8 text at this size (pixels of the em square).
double text_width(std::string_view text, double size, bool bold);

// Height of capitals and figures above the base line, as a share of the size; what hangs below it, likewise.
inline constexpr double cap_height = 0.73;
inline constexpr double descender = 0.24;

// The text's outlines as closed polygons, its base line starting at the origin, y down; curves flattened to 1/20 pixel or better.
// Inner contours run the other way round (nonzero rule).
std::vector<std::vector<Vec2d>> text_outlines(std::string_view text, double size, bool bold);

}  // namespace relievo
