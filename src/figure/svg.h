// A drawing as the text of an SVG file.
#pragma once

#include "figure/drawing.h"

#include <string>

namespace relievo {

// Opens from disk in any browser: no script, no font file, no network. On paper of its own colour, so that it reads on any page;
// Paper::either follows the reader's light or dark setting. Coordinates are rounded to 1/100 pixel. The same drawing gives the
// same bytes.
std::string svg_text(const Drawing& drawing, Paper paper);

}  // namespace relievo
