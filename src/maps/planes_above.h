// Planes above blocks of texels: where a field is smooth, a far closer bound than the highest texel of a block.
#pragma once

#include "core/image.h"

#include <vector>

namespace relievo {

// For every block of 2^k x 2^k texels, k from first_level to last_level, counted from texel (0, 0): three channels, the plane's
// height at the block's first texel and its steps from texel to texel along x and y. No texel of the block is above it but by
// rounding, some 2^-22 of the heights. Its slope is about that of least squares. Texels: one channel, finite. threads 0: all cores.
std::vector<ImageF> planes_above(const ImageF& texels, int first_level, int last_level, int threads = 0);

}  // namespace relievo
