// Largest value in a square window round every texel, repeat addressing: what a roof over the window has to clear.
#pragma once

#include "core/image.h"

namespace relievo {

// out(i, j) = max of in(i + a, j + b) over |a|, |b| <= reach. One channel; reach >= 0; a window wider than the image sees all of it.
// Exact. threads: 0 means all cores.
ImageF box_maximum(const ImageF& in, int reach, int threads = 0);

}  // namespace relievo
