// Pictures joined into one, for figures.
#pragma once

#include "core/image.h"

#include <vector>

namespace relievo {

// Linear RGB as a display takes it: 3 channels, 8 bits, sRGB.
Image8 srgb_picture(const ImageF& linear);

// Side by side with a thin white gap; all of one height, 3 channels.
Image8 beside(const std::vector<Image8>& panels);

// One above the other without a gap; all of one width.
Image8 stacked(const std::vector<Image8>& rows);

// Every pixel as a square of `times` by `times`.
Image8 magnified(const Image8& picture, int times);

// In rows of `abreast`, with a thin gap either way; all of one size, the last row filled up with white.
Image8 in_rows(std::vector<Image8> panels, int abreast);

}  // namespace relievo
