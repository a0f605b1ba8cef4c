// A picture as the bytes of a PNG, for files that hold it within themselves.
#pragma once

#include "core/image.h"

#include <string>

namespace relievo {

// 8 bits a channel, 1 to 4 channels, the values as they are; row 0 of the image becomes the top of the picture. Of at least one texel.
std::string png_bytes(const Image8& image);

}  // namespace relievo
