// Frames of fur as pictures, and how far one is from another.
#pragma once

#include "core/image.h"
#include "render/fur_renderer.h"

namespace relievo {

// A picture against the traced one.
struct FurScore {
    double flip = 0;             // mean LDR-FLIP, backdrop included
    double coverage_error = 0;   // mean difference of coverage, over the pixels where either has any
    double gaps = 0;             // share of the pixels more than half covered in the reference that are less than a quarter covered
    double reference_ms = 0;
    int samples = 0;
};

// Before the backdrop, sRGB, rows top to bottom.
Image8 shown_fur(const FurFrames& frames);

// Of equal height.
Image8 side_by_side(const Image8& left, const Image8& right);

// flip, coverage_error and gaps; the rest is the caller's. Both of one size.
FurScore fur_score(const FurFrames& picture, const FurFrames& reference, int threads = 0);

}  // namespace relievo
