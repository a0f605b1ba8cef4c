// A drawing as a picture.
#pragma once

#include "core/image.h"
#include "figure/drawing.h"

namespace relievo {

// sRGB-encoded, 3 channels, row 0 at the top; `scale` pixels of the picture to one of the drawing. Edges are anti-aliased by their
// exact coverage. Paper::either counts as light. The same drawing gives the same bytes.
Image8 raster(const Drawing& drawing, Paper paper, double scale);

}  // namespace relievo
