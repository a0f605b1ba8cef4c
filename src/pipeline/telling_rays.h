// Which rays of a picture are worth explaining: one that shows how a technique works, one that is hard for it.
#pragma once

#include "core/frame.h"
#include "core/vec.h"

namespace relievo {

struct TellingRays {
    Vec2i typical;  // finds the first hit within half a texel, at the median of fetches
    Vec2i hard;     // misses the first hit, by the median of misses; the most expensive one where nothing is missed
};

// Three frames of one size, as hit_metrics takes them; texels of the height map. Rays that meet the surface high up show little and
// are passed over while there are others. The same frames give the same pixels. At least one pixel must have a hit in both.
TellingRays telling_rays(const Frame& picture, const Frame& reference, const RayField& rays, Vec2i texels);

}  // namespace relievo
