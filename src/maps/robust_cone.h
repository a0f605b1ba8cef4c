// The cone map of robust cone step mapping: Dummer's sampled cones, narrowed to the least of each texel and its eight neighbours.
#pragma once

#include "core/height_field.h"
#include "core/progress.h"

namespace relievo {

// Two channels: the height, and the least ratio of maps/cone_map.h over the 3x3 texels around, with repeat addressing. Read with the
// nearest texel and put at any point of the surface in that texel's square (Ban, Valasek, Balint & Vad 2024, "Robust Cone Step
// Mapping"): narrower than the sampled cones, and still no proof, because a bilinear surface may pierce a cone between texels.
// threads: 0 means all cores; the result does not depend on it. `progress` may throw Cancelled.
ImageF robust_cone(const HeightField& field, int threads = 0, const Progress& progress = {});

// The same from a cone map that is there already.
ImageF robust_cone_of(const ImageF& sampled_cones, int threads = 0);

}  // namespace relievo
