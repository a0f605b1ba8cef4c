// Where a picture is wrong, and what it cost, as pictures with one fixed scale, so that any two can be compared by eye.
#pragma once

#include "core/frame.h"
#include "core/legend.h"
#include "core/vec.h"

namespace relievo {

// One channel, the size of the frames: how far the hit lies behind the true one along the ray, in texels of the height map.
// Positive is late, negative early. Infinity: no surface was found where the reference has one. NaN: not judged, because the ray
// misses the base or the reference has no hit. `texels` is the size of the height map, at least 1x1.
ImageF hit_error_texels(const Frame& picture, const Frame& reference, const RayField& rays, Vec2i texels, int threads = 0);

// The plane above as sRGB: near black where right within half a texel, warm where late, cool where early, logarithmic from half
// a texel to 64 texels, and beyond that the last colour. White: no surface found. Grey: not judged. Late and early colours of
// the same error have the same lightness, the hues are orange and blue: told apart by all common kinds of colour blindness.
Image8 hit_error_picture(const ImageF& error_texels, int threads = 0);
Legend hit_error_legend();

// The fetches of each pixel as sRGB, dark to light, logarithmic from 1 to 128 and linear from 0 to 1; white and grey as above.
Image8 fetches_picture(const Frame& picture, int threads = 0);
Legend fetches_legend();

}  // namespace relievo
