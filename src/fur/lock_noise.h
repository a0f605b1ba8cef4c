// Smooth noise that repeats: by it locks of strands sway together.
#pragma once

#include "core/vec.h"

#include <array>
#include <cstdint>
#include <vector>

namespace relievo {

// Values in [-1,1] as signed bytes (127 is 1), three and a fourth that is 0, at the texel centres of a cube of `size` a side, x first;
// it repeats. Hills four texels wide carry hills of half their width and height, so that locks divide toward their tips.
struct LockNoise {
    static constexpr int size = 32;
    static constexpr int hills = 8;  // in a period
    std::vector<std::array<std::int8_t, 4>> texels;
};
LockNoise lock_noise();

// The three values at p, where a period is one unit: trilinear, repeating, as a sampler reads them.
Vec3d lock_noise_at(const LockNoise& noise, Vec3d p);

}  // namespace relievo
