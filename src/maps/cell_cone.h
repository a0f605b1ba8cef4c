// The cell cone map: over every bilinear cell of the repeated field, and toward each quadrant of the plane, a cone in terraces that
// holds nothing of it: how high the field is in the cell, and in three squares of cells ahead, each wider than the last. What a ray may
// skip without missing the declared surface.
#pragma once

#include "core/height_field.h"
#include "core/progress.h"

namespace relievo {

// The values that a channel takes, k from 0 to 255.
inline float cell_cone_level(int k) { return static_cast<float>(k / 255.0); }

// One image a quadrant, stacked upward: quadrant q of cell (i, j) is texel (i, q * height + j). q & 1 looks toward smaller i, else
// larger; q & 2 toward smaller j, else larger. The cell's corners are texels i, i+1 and j, j+1 with repeat addressing. Four channels,
// each rounded up to a whole number of 1/255, so that a device holds a cell in 32 bits (in 64, roofs would be lower by 1/500 in the mean
// and fetches 5 % fewer, and a search on the processor 8 % slower, for what its caches no longer hold):
//   0        M, the cell's largest corner;
//   1, 2, 3  the largest M of the cells from this one to near_roof_reach, middle_roof_reach and far_roof_reach cells farther, along
//            both axes, in the quadrant.
// Exact, from M on. Straight cones, a slope away from the cell's walls instead of terraces, take 1.3 times the fetches in the
// mean of fBm, cobbles and spikes, and cones toward all sides at once with them no fewer (docs/concepts/exact_casting.md).
// The result does not depend on the number of threads (0: all cores).
// Heights are finite and in [0,1], sides at most 16384. `progress` may throw Cancelled.
// render/cell_cone_bake.h makes the same bits on a device.
ImageF cell_cone_map(const HeightField& field, int threads = 0, const Progress& progress = {});

}  // namespace relievo
