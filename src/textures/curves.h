// Curves of one variable that shape profiles and tints.
#pragma once

#include "core/vec.h"
#include "textures/hash.h"

#include <algorithm>
#include <cmath>

namespace relievo {

constexpr float saturate(float x) { return std::clamp(x, 0.0f, 1.0f); }

constexpr float mix(float a, float b, float t) { return a + (b - a) * t; }
constexpr Vec3f mix(Vec3f a, Vec3f b, float t) { return a + (b - a) * t; }

// Where x lies between two edges, clamped; the edges may be given in falling order.
constexpr float ramp(float from, float to, float x) { return saturate((x - from) / (to - from)); }

// The same with level ends (the cubic 3t^2 - 2t^3).
constexpr float smooth_ramp(float from, float to, float x) {
    const float t = ramp(from, to, x);
    return t * t * (3 - 2 * t);
}

// Minimum and maximum with the corner rounded over a width k (polynomial blend of second order).
inline float smooth_min(float a, float b, float k) {
    const float h = std::max(k - std::abs(a - b), 0.0f) / k;
    return std::min(a, b) - h * h * k * 0.25f;
}
inline float smooth_max(float a, float b, float k) { return -smooth_min(-a, -b, k); }

// A quarter of a circle from (0,0), vertical, to (1,1), level: the shoulder of a worn edge or a pebble.
inline float shoulder(float t) {
    const float x = 1 - saturate(t);
    return std::sqrt(std::max(0.0f, 1 - x * x));
}

// cos(2 pi t) for any t of moderate size, to 4e-6, without the library: an even polynomial of degree 12 (Taylor) on half a period.
inline float cos_turns(float t) {
    const float r = std::abs(t - static_cast<float>(floor_index(t)) - 0.5f);  // 0 at the minimum, 1/2 at the maximum
    const float q = std::abs(r - 0.25f) * 6.28318531f;  // distance from the zero crossing, in radians, at most pi/2
    const float q2 = q * q;
    const float sine = q * (1 - q2 / 6 * (1 - q2 / 20 * (1 - q2 / 42 * (1 - q2 / 72 * (1 - q2 / 110)))));
    return r > 0.25f ? sine : -sine;
}
inline float sin_turns(float t) { return cos_turns(t - 0.25f); }

}  // namespace relievo
