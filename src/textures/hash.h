// Random numbers that are functions of a lattice point: the same on every thread and machine.
#pragma once

#include "core/wrap.h"

#include <cstdint>

namespace relievo {

// A bijection of 32 bits with low bias (xor-shift and multiply; constants found by search: Wellons, "Prospecting for hash
// functions", 2018).
constexpr std::uint32_t scramble(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

// The largest integer not above x; std::floor is a call on the oldest x86-64, and noise asks for four of these a texel and octave.
constexpr int floor_index(float x) {
    const int i = static_cast<int>(x);
    return i - (x < static_cast<float>(i) ? 1 : 0);
}

// wrap_index for indices that are nearly always inside: a division would cost more than the rest of the noise.
constexpr int lattice_index(int i, int cells) {
    return static_cast<std::uint32_t>(i) < static_cast<std::uint32_t>(cells) ? i : wrap_index(i, cells);
}

constexpr std::uint32_t hash(std::uint32_t a, std::uint32_t b) { return scramble(a + 0x9e3779b9u + scramble(b)); }

// A uniform number in [0,1) with 24 bits: exactly representable, so no rounding can reach 1.
constexpr float unit(std::uint32_t h) { return static_cast<float>(h >> 8) * (1.0f / 16777216.0f); }

// A stream of uniform numbers belonging to one thing (a stone, a brick): take as many as it has properties.
class Dice {
public:
    constexpr explicit Dice(std::uint32_t seed) : state_(seed) {}
    constexpr std::uint32_t bits() { return state_ = scramble(state_ + 0x9e3779b9u); }
    constexpr float roll() { return unit(bits()); }
    constexpr float roll(float low, float high) { return low + (high - low) * roll(); }

private:
    std::uint32_t state_;
};

}  // namespace relievo
