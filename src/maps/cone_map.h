// Dummer's cone map: over each texel the widest upward cone that holds no other texel of the repeated field (Dummer 2006).
#pragma once

#include "core/height_field.h"
#include "core/progress.h"

namespace relievo {

// (d/size)^2, its share of d2 below.
inline float squared_distance(int d, int size) {
    const float uv = static_cast<float>(d) / static_cast<float>(size);
    return uv * uv;
}

// Two channels: the height, and the cone's ratio (UV radius per unit of height, in (0, 1]), the largest c <= 1 with
//   c (h_y - h_x) <= |uv_y - uv_x|   for every higher texel y, at its nearest repeat.
// Exact over all texels, and defined to the last bit in float: with whole texel distances di, dj (at most half a period),
//   d2 = (di/w)^2 + (dj/h)^2,  q = min over y of d2 / (h_y - h_x)^2,  ratio = sqrt(min(q, 1)),
// so the result depends neither on the search's order nor on the number of threads (0: all cores).
// Heights are finite and in [0,1]. `progress` may throw Cancelled. render/cone_bake.h makes the same bits on a device.
ImageF cone_map(const HeightField& field, int threads = 0, const Progress& progress = {});

}  // namespace relievo
