// What a picture shows on an 8-bit sRGB display, without the rounding to 8 bits: the ground on which pictures are compared.
#pragma once

#include "core/image.h"

#include <string>

namespace relievo {

// IEC 61966-2-1 transfer function of one linear value in [0,1], result in [0,1].
float srgb_encoded(float linear);

// Linear RGB (3 channels) clamped to [0,1], which is what a display does with brighter light. `name` says in messages which
// picture is meant ("the picture", "the reference"). Throws Error naming the first pixel that is not a finite number, top row
// first.
ImageF clamped_to_display(const ImageF& linear_rgb, const std::string& name, int threads = 0);

// The same, then sRGB-encoded.
ImageF display_values(const ImageF& linear_rgb, const std::string& name, int threads = 0);

}  // namespace relievo
