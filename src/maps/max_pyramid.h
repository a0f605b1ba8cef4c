// Pyramid of the largest heights of groups of bilinear cells (Tevs, Ihrke & Seidel 2008), in the layout of core/map_set.h.
#pragma once

#include "core/map_set.h"

namespace relievo {

// Levels of the pyramid of a field of this size: about 4 to 8 nodes remain across the longer side, because a ray enters the
// slab at the top level and wider nodes hardly ever lie below it. Long thin fields get fewer, so that the padding stays small.
int max_pyramid_levels(int width, int height);

// Level 0 holds the largest corner of each cell (i, j), whose corners are texels i, i+1 and j, j+1 with repeat addressing; a node
// of level k the maximum of its 2x2 children. Exact maxima, no rounding. threads: 0 means all cores.
MaxPyramid max_pyramid(const HeightField& field, int threads = 0);

}  // namespace relievo
