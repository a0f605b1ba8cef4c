// Values as a reader gets them back from 16 bits, moved in the direction that leaves a map safe to skip by.
#pragma once

#include "core/image.h"

#include <array>
#include <cmath>

namespace relievo {

// Which way a value may move when it is stored in 16 bits without making the map unsafe to skip by.
enum class Rounding { nearest, up, down };

// The nearest of the 65536 values that a reader gets back from 16 bits, or the next one in the safe direction.
inline float on_grid(float value, Rounding rounding) {
    constexpr float steps = 65535.0f;
    const float step = std::round(value * steps);
    if (rounding == Rounding::up && step / steps < value) return (step + 1) / steps;
    if (rounding == Rounding::down && step / steps > value) return (step - 1) / steps;
    return step / steps;
}

// Every texel of a map so stored, each channel with its own rounding.
inline ImageF as_stored(ImageF map, const std::array<Rounding, 4>& rounding) {
    for (std::size_t k = 0; k < map.texels.size(); ++k)
        map.texels[k] = on_grid(map.texels[k], rounding[k % static_cast<std::size_t>(map.channels)]);
    return map;
}

}  // namespace relievo
