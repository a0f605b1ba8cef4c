// What a search for the first hit found, against where the first hit truly is.
#pragma once

#include "core/frame.h"
#include "core/measurement.h"
#include "core/vec.h"

#include <vector>

namespace relievo {

struct HitMetrics {
    Measured<double> missed_first_hit;
    Measured<double> early_hit;
    Measured<Percentiles> uv_error_texels;
    Measured<Percentiles> height_error;
    Measured<Percentiles> normal_error_deg;
    Measured<double> shadow_mismatch;
    Measured<FetchCount> fetches;
};

// Three frames of one size; `texels` is the size of the height map, the unit of UV errors (0: there is none, and what is counted
// in texels is missing). The sets of pixels:
//   judged     the ray meets the base and the reference has a hit. Shares of missed and early hits are of these.
//   compared   judged, and the picture has a hit too. UV, height and normal errors and the shadow are of these: where no surface
//              was found there is nothing to compare, and the pixel already counts as missed.
//   searched   the picture has a hit; fetches are of these.
// Late and early are decided along the ray (along_ray.h), the UV error is the whole distance in texels, and coordinates are
// compared as they are, not modulo the period. A metric of an empty set is missing and says so; every number is finite.
// Throws Error naming the plane and the pixel where a hit carries a number that is not finite, or a normal without length.
HitMetrics hit_metrics(const Frame& picture, const Frame& reference, const RayField& rays, Vec2i texels, int threads = 0);

// The smallest value that at least the share p of the values do not exceed (nearest rank: element ceil(p n) of the sorted values,
// counted from one): always a value that occurred. p in (0,1], values not empty; they are reordered.
double nearest_rank(std::vector<float>& values, double p);

}  // namespace relievo
