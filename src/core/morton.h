// Morton's curve through a grid in space: what is near along it is near in space (Morton 1966).
#pragma once

#include <cstdint>

namespace relievo {

constexpr int morton_bits = 21;  // of each coordinate: three in 63

// 21 bits, two zeros after each.
constexpr std::uint64_t morton_spread(std::uint64_t v) {
    v = (v | v << 32) & 0x001f00000000ffffu;
    v = (v | v << 16) & 0x001f0000ff0000ffu;
    v = (v | v << 8) & 0x100f00f00f00f00fu;
    v = (v | v << 4) & 0x10c30c30c30c30c3u;
    return (v | v << 2) & 0x1249249249249249u;
}

// A cell's number along the curve, x in the lowest bit. Coordinates are below 2^21.
constexpr std::uint64_t morton(std::uint64_t x, std::uint64_t y, std::uint64_t z) { return morton_spread(x) | morton_spread(y) << 1 | morton_spread(z) << 2; }

}  // namespace relievo
