// The pyramid that searches for cones of texels walk down.
#pragma once

#include "core/image.h"

#include <vector>

namespace relievo {

// Largest texel of blocks of 2^k x 2^k texels, level k, up to a single node; sizes rounded up. One channel; at least `least_levels`.
// threads: 0 means all cores.
std::vector<ImageF> texel_maxima(const ImageF& texels, int least_levels, int threads);

}  // namespace relievo
