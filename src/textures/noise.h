// Gradient noise on a periodic lattice and its sums of octaves.
//
// Perlin, "An image synthesizer", SIGGRAPH 1985; Perlin, "Improving noise", SIGGRAPH 2002 (the quintic fade 6t^5 - 15t^4 + 10t^3
// and gradients from a small fixed set). Lattice indices are wrapped before they are hashed, so the noise repeats exactly.
#pragma once

#include "textures/surface_function.h"

#include <array>
#include <cstdint>

namespace relievo {

// Noise in [-1,1], mean 0, standard deviation about 0.3, on a lattice of cells_u x cells_v cells per unit of UV.
float gradient_noise(Vec2f uv, int cells_u, int cells_v, std::uint32_t seed);

// A sum of octaves, each twice as fine as the one before and `gain` times as strong. Octaves finer than the texel raster can hold
// are faded out (Perlin 1985 on band limiting), so a small map is the large one seen from farther away.
struct FractalSpec {
    int cells_u = 4;  // of the first octave
    int cells_v = 4;
    int octaves = 4;  // at most 8
    float gain = 0.5f;
};

class FractalNoise {
public:
    // `salt` tells apart the several noises of one material.
    FractalNoise(FractalSpec spec, const Detail& detail, std::uint32_t salt);

    // About [-1,1], mean 0.
    float operator()(Vec2f uv) const;

    // Sum of absolute values ("turbulence"), about [0,1], creased where an octave crosses zero.
    float turbulence(Vec2f uv) const;

private:
    struct Octave {
        int cells_u, cells_v;
        std::uint32_t seed;
        float weight;
    };
    std::array<Octave, 8> octaves_{};
    int count_ = 0;
};

}  // namespace relievo
