// IEEE 754 binary16 from a float, rounded to nearest even; beyond its range it becomes infinite.
#pragma once

#include <bit>
#include <cstdint>

namespace relievo::gpu {

constexpr std::uint16_t to_half(float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const auto sign = static_cast<std::uint16_t>((bits >> 16) & 0x8000u);
    const std::uint32_t magnitude = bits & 0x7fffffffu;
    if (magnitude > 0x7f800000u) return static_cast<std::uint16_t>(sign | 0x7e00u);   // not a number
    if (magnitude >= 0x477ff000u) return static_cast<std::uint16_t>(sign | 0x7c00u);  // 65520 and more round to infinity
    std::uint32_t half = 0;
    std::uint32_t rest = 0;          // the bits dropped, their first at bit 31
    if (magnitude >= 0x38800000u) {  // 2^-14: normal halves; exponents differ by 127 - 15
        half = (magnitude - 0x38000000u) >> 13;
        rest = magnitude << 19;
    } else if (magnitude >= 0x33000000u) {  // 2^-25: subnormal halves, in steps of 2^-24
        const std::uint32_t mantissa = (magnitude & 0x7fffffu) | 0x800000u;
        const std::uint32_t shift = 126u - (magnitude >> 23);
        half = mantissa >> shift;
        rest = mantissa << (32u - shift);
    }
    if (rest > 0x80000000u || (rest == 0x80000000u && (half & 1u) != 0)) ++half;
    return static_cast<std::uint16_t>(sign | half);
}

static_assert(to_half(1.0f) == 0x3c00 && to_half(-2.0f) == 0xc000 && to_half(0.0f) == 0 && to_half(65504.0f) == 0x7bff);
static_assert(to_half(5.9604645e-8f) == 1 && to_half(1.0f + 0x1p-11f) == 0x3c00 && to_half(1.0f + 0x3p-11f) == 0x3c02);

}  // namespace relievo::gpu
