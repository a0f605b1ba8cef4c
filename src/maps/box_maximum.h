// Largest value in the square window that begins at every texel, repeat addressing: what a roof over the window has to clear.
#pragma once

#include "core/image.h"

namespace relievo {

// out(i, j) = max of in(i + a, j + b) over 0 <= a, b < side. One channel; side >= 1; a window wider than the image sees all of it.
// Exact. threads: 0 means all cores.
ImageF box_maximum(const ImageF& in, int side, int threads = 0);

}  // namespace relievo
