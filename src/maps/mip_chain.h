// Mip chains as every machine reads them: Vulkan's sizes (halved, rounded down, to 1x1), each texel the area average of the
// texels it covers, odd sizes included. GPU and reference are given the same texels.
#pragma once

#include "core/image.h"

#include <vector>

namespace relievo {

// Unit normals (3 channels); each level is the mean of level 0's normals over the texel, renormalised at the end, so that
// the rounding of one level does not enter the next. Where normals cancel exactly the texel is (0, 0, 1).
// The first level is the argument, untouched. threads: 0 means all cores; the result does not depend on it.
std::vector<ImageF> normal_mip_chain(ImageF normals, int threads = 0);

// sRGB-encoded RGB and linear alpha (4 channels), averaged in linear light and rounded to the nearest code at each level, again
// without feeding rounded values on. Colour is not weighted by alpha: what lies under alpha 0 counts.
std::vector<Image8> colour_mip_chain(Image8 colour, int threads = 0);

// The sRGB transfer curve (IEC 61966-2-1), encoded and linear both in [0,1].
float srgb_to_linear(float encoded);
float linear_to_srgb(float linear);

}  // namespace relievo
