// A train of waves that follows a given phase but breaks and forks like ripples do: a sum of short wavelets.
//
// Sparse convolution of a cosine under a window, after Lagae et al., "Procedural noise using sparse Gabor convolution", SIGGRAPH
// 2009 (eq. 5-7), with two changes: wavelet phases come from one phase function, plus a random part, so that crests are long; and
// the sum is divided by the sum of windows, so that the amplitude is even.
#pragma once

#include "core/vec.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace relievo {

class WaveField {
public:
    // `cells` wavelets across the tile, each two cells wide. `phase` in turns; it may grow by whole turns over a period.
    // `disorder`: largest random part of a wavelet's phase, in turns; at 0 the crests are the lines where the phase is whole.
    WaveField(int cells, const std::function<float(Vec2f)>& phase, float disorder, std::uint32_t seed);

    // In [-1,1].
    float at(Vec2f uv) const;

private:
    struct Wavelet {
        Vec2f centre;  // in cells, relative to its own cell
        Vec2f wave;    // turns per cell
        float phase;   // turns, at the centre
    };
    int cells_;
    std::vector<Wavelet> wavelets_;
};

}  // namespace relievo
