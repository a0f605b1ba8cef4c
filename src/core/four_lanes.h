// Four numbers side by side under GCC's and Clang's vector extension, which every processor we know has in one register. Left to themselves the compilers vectorise loops
// in some surroundings and not in others. Wider registers are for core/each_machine.h.
#pragma once

#include <cstdint>
#include <cstring>

namespace relievo {

using FourLanes = float __attribute__((vector_size(16)));
using FourMask = std::int32_t __attribute__((vector_size(16)));

inline FourLanes four_from(const float* from) {
    FourLanes v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
inline bool any(FourMask mask) {
    std::uint64_t half[2];
    std::memcpy(half, &mask, sizeof half);
    return (half[0] | half[1]) != 0;
}
// A lane's answer in the bit of its number.
inline std::uint32_t bits_of(FourMask mask) {
    std::uint32_t bits = 0;
    for (int l = 0; l < 4; ++l) bits |= mask[l] != 0 ? 1u << l : 0u;
    return bits;
}

}  // namespace relievo
