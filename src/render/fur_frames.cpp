#include "render/fur_frames.h"

#include "core/parallel_for.h"

#include <array>
#include <cassert>
#include <cmath>

namespace relievo {

void add_pass(FurFrames& frames, std::span<const std::uint8_t> rgba, int passes) {
    assert(rgba.size() == frames.coverage.texels.size() * 4 && passes >= 1);
    std::array<float, 256> linear;
    for (std::size_t i = 0; i < 256; ++i) {
        const double v = static_cast<double>(i) / 255;
        linear[i] = static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    }
    const float weight = 1 / static_cast<float>(passes);
    parallel_for(static_cast<int>(frames.coverage.texels.size()), 65536, 0, [&](int begin, int end) {
        for (auto p = static_cast<std::size_t>(begin); p < static_cast<std::size_t>(end); ++p) {
            const std::uint8_t* from = &rgba[p * 4];
            if (from[3] == 0) continue;
            for (std::size_t c = 0; c < 3; ++c) frames.colour.texels[p * 3 + c] += weight * linear[from[c]];
            frames.coverage.texels[p] += weight * static_cast<float>(from[3]) / 255;
        }
    });
}

}  // namespace relievo
