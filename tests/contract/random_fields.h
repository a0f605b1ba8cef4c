// Fields without symmetry, the same in every run: seeded, tileable, of a size that is neither square nor a power of two.
#pragma once

#include "core/height_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace relievo::contract {

inline void stretch_to_unit(HeightField& field) {
    const auto [low, high] = std::ranges::minmax(field.texels.texels);
    for (float& h : field.texels.texels) h = (h - low) / (high - low);
}

// A sum of waves whose amplitude falls as frequency^-slope, up to `highest` periods per repeat.
inline HeightField random_field(int width, int height, int highest, double slope, unsigned seed) {
    std::mt19937 random(seed);
    const auto unit = [&] { return static_cast<double>(random() >> 8) / 16777216.0; };
    HeightField field(width, height);
    for (int fx = 0; fx <= highest; ++fx) {
        for (int fy = -highest; fy <= highest; ++fy) {
            if (fx == 0 && fy <= 0) continue;
            const double amplitude = (unit() + 0.2) * std::pow(std::hypot(fx, fy), -slope);
            const double phase = 2 * std::numbers::pi * unit();
            for (int j = 0; j < height; ++j)
                for (int i = 0; i < width; ++i)
                    field.texels(i, j) += static_cast<float>(
                        amplitude * std::cos(phase + 2 * std::numbers::pi * (fx * (i + 0.5) / width + fy * (j + 0.5) / height)));
        }
    }
    stretch_to_unit(field);
    return field;
}

// Rolling ground: no wave shorter than a third of the repeat.
inline HeightField smooth_field(unsigned seed) { return random_field(80, 56, 3, 1.5, seed); }

// Rubble down to the texel: waves to an eighteenth of the repeat, noise on every texel, and one spike of a single texel in 90.
inline HeightField rough_field(unsigned seed) {
    HeightField field = random_field(80, 56, 18, 0.9, seed);
    std::mt19937 random(seed + 1);
    for (float& h : field.texels.texels) {
        h = 0.8f * h + 0.1f * static_cast<float>(random() >> 8) / 16777216.0f;
        if (random() % 90 == 0) h += 0.4f;
    }
    stretch_to_unit(field);
    return field;
}

// Every texel on its own: walls on all sides of each.
inline HeightField noise_field(unsigned seed) {
    HeightField field(160, 112);
    std::mt19937 random(seed);
    for (float& h : field.texels.texels) h = static_cast<float>(random() >> 8) / 16777216.0f;
    stretch_to_unit(field);
    return field;
}

// Every texel on the floor or at the top by the toss of a coin: as many walls as a field of this size can have.
inline HeightField coins_field(unsigned seed) {
    HeightField field(160, 112);
    std::mt19937 random(seed);
    for (float& h : field.texels.texels) h = random() >> 31 != 0 ? 1.0f : 0.0f;
    return field;
}

// Blocks of 5 to 11 texels on a side, each of its own height, with sheer walls between: what waves of any kind do not have.
inline HeightField blocks_field(unsigned seed) {
    HeightField field(80, 56);
    std::mt19937 random(seed);
    for (int k = 0; k < 220; ++k) {
        const int x = static_cast<int>(random() % 80);
        const int y = static_cast<int>(random() % 56);
        const int wide = 5 + static_cast<int>(random() % 7);
        const int deep = 5 + static_cast<int>(random() % 7);
        const float h = static_cast<float>(random() >> 8) / 16777216.0f;
        for (int j = y; j < y + deep; ++j)
            for (int i = x; i < x + wide; ++i) field.texels(wrap_index(i, 80), wrap_index(j, 56)) = h;
    }
    stretch_to_unit(field);
    return field;
}

}  // namespace relievo::contract
