// Numbers in text files of meshes. Text handed to these functions ends with a newline, end[-1], and p points before it: nothing here has
// to ask after every byte whether the text is over.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace relievo::text {

inline bool is_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }

// What separates numbers on a line.
inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f'; }

// Any spelling: a sign, "2.", ".5", "1d3", "3.1+e2", "1.#INF", "nan", "infinity"; correctly rounded; too large is infinite.
bool read_unusual_float(const char*& p, float& value);

// Powers of ten that a double holds exactly.
inline constexpr std::array<double, 23> exact_power_of_ten = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                                              1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

inline constexpr std::array<std::uint32_t, 9> power_of_ten = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};

// Up to eight digits at q, where eight bytes can be read: their number in `value`, their count returned. No branch depends on how
// many there are (Lemire, "Number parsing at a gigabyte per second", 2021, section 3).
inline int read_eight_digits(const char* q, std::uint32_t& value) {
    std::uint64_t word = 0;
    std::memcpy(&word, q, 8);
    word ^= 0x3030303030303030u;  // digits become 0 to 9
    const std::uint64_t others = ((word + 0x7676767676767676u) | word) & 0x8080808080808080u;
    const int count = others == 0 ? 8 : std::countr_zero(others) / 8;
    if (count == 0) {
        value = 0;
        return 0;
    }
    word <<= 64 - 8 * count;  // zeros in front
    word = word * 10 + (word >> 8);
    constexpr std::uint64_t mask = 0x000000ff000000ffu;
    value = static_cast<std::uint32_t>(((word & mask) * 0x000f424000000064u + ((word >> 16) & mask) * 0x0000271000000001u) >> 32);
    return count;
}

// The number at p as the nearest float (correctly rounded); p moves behind it. False, and p stays, where there is no number.
// Clinger's fast path ("How to read floating point numbers accurately", 1990): digits and power of ten are exact doubles, so one
// division rounds correctly; rounding that to float a second time errs only where the double lies exactly between two floats.
inline bool read_float(const char*& p, const char* end, float& value) {
    const char* q = p;
    const bool negative = *q == '-';
    q += negative || *q == '+';
    std::uint64_t digits = 0;
    const char* const whole = q;
    while (is_digit(*q)) digits = digits * 10 + static_cast<std::uint64_t>(*q++ - '0');
    auto count = q - whole;
    long exponent = 0;
    if (*q == '.') {
        const char* const fraction = ++q;
        if (end - q >= 8) {
            std::uint32_t eight = 0;
            const int n = read_eight_digits(q, eight);
            digits = digits * power_of_ten[static_cast<std::size_t>(n)] + eight;
            q += n;
        }
        while (is_digit(*q)) digits = digits * 10 + static_cast<std::uint64_t>(*q++ - '0');
        exponent = static_cast<long>(fraction - q);
        count += q - fraction;
    }
    if ((*q | 32) == 'e' && count > 0) {
        const char* r = q + 1;
        const bool minus = *r == '-';
        r += minus || *r == '+';
        if (!is_digit(*r)) return read_unusual_float(p, value);
        long e = 0;
        while (is_digit(*r) && e < 10000) e = e * 10 + (*r++ - '0');
        exponent += minus ? -e : e;
        q = r;
    }
    if (count == 0 || count > 19 || digits > (std::uint64_t{1} << 53) || exponent < -22 || exponent > 22 || !(is_blank(*q) || *q == '\n'))
        return read_unusual_float(p, value);
    double d = static_cast<double>(digits);
    d = exponent < 0 ? d / exact_power_of_ten[static_cast<std::size_t>(-exponent)] : d * exact_power_of_ten[static_cast<std::size_t>(exponent)];
    constexpr std::uint64_t below_float = (std::uint64_t{1} << 29) - 1, halfway = std::uint64_t{1} << 28;
    if ((std::bit_cast<std::uint64_t>(d) & below_float) == halfway || !(d == 0 || (d >= 0x1p-126 && d <= 0x1.fffffep127)))
        return read_unusual_float(p, value);
    value = static_cast<float>(negative ? -d : d);
    p = q;
    return true;
}

// A whole number; beyond +-2^40 it stays there (no index is that large). False, and p stays, where there is none.
inline bool read_integer(const char*& p, std::int64_t& value) {
    const char* q = p;
    const bool negative = *q == '-';
    q += negative || *q == '+';
    if (!is_digit(*q)) return false;
    constexpr std::int64_t limit = std::int64_t{1} << 40;
    std::int64_t v = 0;
    while (is_digit(*q)) {
        v = v * 10 + (*q++ - '0');
        if (v > limit) v = limit;
    }
    value = negative ? -v : v;
    p = q;
    return true;
}

}  // namespace relievo::text
