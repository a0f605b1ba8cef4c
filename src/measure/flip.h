// LDR-FLIP: how different two pictures look when one flips between them.
//   P. Andersson, J. Nilsson, T. Akenine-Moller, M. Oskarsson, K. Astrom, M. D. Fairchild: FLIP: A Difference Evaluator for
//   Alternating Images. Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020.
#pragma once

#include "core/image.h"

namespace relievo {

struct FlipSettings {
    double pixels_per_degree = 67.0;  // of visual angle, at least 1: 0.7 m from a 0.7 m wide, 3840 pixel wide display
    int threads = 0;                  // 0: all cores; the result does not depend on it
};

struct FlipResult {
    ImageF error;     // 1 channel, [0,1], one value per pixel: 0 looks the same, 1 as different as can be
    double mean = 0;  // of error
};

// Both pictures linear RGB of one size, 3 channels, clamped to [0,1] as a display does. Beyond the border the nearest pixel is
// repeated. Identical pictures give exactly 0, and exchanging the two changes nothing. Throws Error naming the pixel that is not
// finite, or for pixels_per_degree below 1.
FlipResult flip(const ImageF& picture, const ImageF& reference, const FlipSettings& settings = {});

}  // namespace relievo
