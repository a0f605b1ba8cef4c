// Peak signal-to-noise ratio of two pictures as a display shows them.
#pragma once

#include "core/image.h"
#include "core/measurement.h"

namespace relievo {

// 10 log10(1 / MSE) in decibels over all pixels and the three channels of sRGB-encoded values in [0,1] (display_values), not
// rounded to 8 bits. Both pictures of the same size and at least one pixel. Identical pictures have no finite ratio: missing,
// with the reason "identical pictures".
Measured<double> psnr_db(const ImageF& display_picture, const ImageF& display_reference, int threads = 0);

}  // namespace relievo
