// Height fields the tests of maps share.
#pragma once

#include "core/height_field.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace relievo::test {

inline HeightField random_field(int width, int height, unsigned seed) {
    HeightField field(width, height);
    std::mt19937 random(seed);
    for (float& h : field.texels.texels) h = static_cast<float>(random() >> 8) * 0x1p-24f;
    return field;
}

// 16-bit heights with plateaus, as image files hold them: equal texels and exact ties occur.
inline HeightField terraced_field(int width, int height, unsigned seed) {
    HeightField field = random_field(width, height, seed);
    for (float& h : field.texels.texels) h = std::floor(h * 5) * 13107.0f / 65535.0f;
    return field;
}

inline HeightField spike_field(int width, int height, int x, int y) {
    HeightField field(width, height);
    field.texels(x, y) = 1.0f;
    return field;
}

// A few waves that repeat with the texture, amplitudes falling with frequency; range inside [0,1].
inline HeightField smooth_field(int width, int height, unsigned seed) {
    HeightField field(width, height);
    std::mt19937 random(seed);
    struct Wave {
        int kx, ky;
        double phase, amplitude;
    };
    std::array<Wave, 12> waves;
    double total = 0;
    for (Wave& w : waves) {
        w.kx = static_cast<int>(random() % 9) - 4;
        w.ky = static_cast<int>(random() % 9) - 4;
        w.phase = static_cast<double>(random() % 1000) / 1000 * 2 * std::numbers::pi;
        w.amplitude = 1.0 / (1 + w.kx * w.kx + w.ky * w.ky);
        total += w.amplitude;
    }
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
            double h = 0;
            for (const Wave& w : waves)
                h += w.amplitude * std::sin(2 * std::numbers::pi * (w.kx * (i + 0.5) / width + w.ky * (j + 0.5) / height) + w.phase);
            field.texels(i, j) = static_cast<float>(0.5 + 0.5 * h / total);
        }
    return field;
}

}  // namespace relievo::test
