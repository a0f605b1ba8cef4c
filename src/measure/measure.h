// One Frame judged against another.
#pragma once

#include "core/frame.h"
#include "core/measurement.h"

namespace relievo {

struct MeasureSettings {
    int texels_x = 0;   // size of the height map, the unit of UV errors; 0: there is none, what is counted in texels is missing
    int texels_y = 0;
    double pixels_per_degree = 67.0;  // FLIP's viewing distance: 0.7 m from a 0.7 m wide, 3840 pixel wide display
    int threads = 0;
};

// Everything but gpu_ms, which is not a property of two pictures. Metrics of hits use pixels where both rays and reference hit;
// "along the ray" is the direction in UV in which the ray descends (hits.h says which pixels count where). Colours are compared as
// a display shows them, clamped to [0,1] (flip.h, ssim.h, psnr.h).
// Throws Error where the three differ in size, or a colour or the facts of a hit are not finite numbers; the pixel is named.
Measurement measure(const Frame& picture, const Frame& reference, const RayField& rays, const MeasureSettings& settings);

}  // namespace relievo
