// The structural similarity index.
//   Z. Wang, A. C. Bovik, H. R. Sheikh, E. P. Simoncelli: Image Quality Assessment: From Error Visibility to Structural Similarity.
//   IEEE Transactions on Image Processing 13(4), 2004, section III: 11 x 11 Gaussian window of standard deviation 1.5 pixels,
//   K1 = 0.01, K2 = 0.03.
#pragma once

#include "core/image.h"

namespace relievo {

// Mean SSIM, in [-1,1], 1 exactly for identical pictures. Both pictures sRGB-encoded RGB in [0,1] (display_values), of the same
// size and at least one pixel; compared by their luma 0.2126 R' + 0.7152 G' + 0.0722 B' (BT.709 weights). The window is reflected
// at the border, the outermost pixel included (dcba|abcd|dcba), so that small pictures and the pixels of the rim are judged too;
// variances are those of the weighted window, without a correction for a sample.
double ssim(const ImageF& display_picture, const ImageF& display_reference, int threads = 0);

}  // namespace relievo
