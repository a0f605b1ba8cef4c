// Quick cones (Valasek & Ban 2022, "Quick Cone Map Generation on the GPU"), a rival that the verifier judges beside ours.
#pragma once

#include "core/height_field.h"

namespace relievo {

// Height and ratio (at most 1). Every texel looks, on each level of a pyramid of texel maxima, at the eight blocks around its own, and
// takes for each the largest height at the distance of the nearest texel centre of the block: so many looks as the pyramid has
// levels, N^2 log N in all, and never wider than the sampled cone. This is the first of the paper's methods, written from what its
// abstract says; the wider ones that skip regions seen before lie between it and the sampled cone. Blocks are cut off at the
// period's end. threads: 0 means all cores.
ImageF quick_cone(const HeightField& field, int threads = 0);

}  // namespace relievo
