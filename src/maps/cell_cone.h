// The cell cone map: over every bilinear cell of the repeated field the widest upward cone that holds nothing of it, wherever in the
// cell the cone stands, and how high the field is round the cell. What a ray may skip without missing the declared surface.
#pragma once

#include "core/height_field.h"
#include "core/progress.h"

namespace relievo {

// Four channels for cell (i, j), whose corners are texels i, i+1 and j, j+1 with repeat addressing, each a whole number of 1/65535, so
// that a device holds them in 16 bits:
//   0  M, its largest corner, rounded up;
//   1  c in (0, 1], UV radius per unit of height, rounded down: with D(y) the UV distance of a point y from the cell,
//      h(y) <= M + D(y) / c   for every point y of the declared surface;
//   2, 3  the largest M of the cells within near_roof_reach and far_roof_reach cells, along either axis.
// c is a lower bound of the largest such number: at least half of it, and 0.85 of it in the mean, on the tests' fields (0.99 and more on
// smooth ones), unless texels are more than 2.6 times longer than wide.
// Defined to the last bit: the result depends neither on the search's order nor on the number of threads (0: all cores).
// Heights are finite and in [0,1], sides at most 16384. `progress` may throw Cancelled.
ImageF cell_cone_map(const HeightField& field, int threads = 0, const Progress& progress = {});

}  // namespace relievo
