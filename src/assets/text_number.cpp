#include "assets/text_number.h"

#include <charconv>
#include <limits>
#include <string>

namespace relievo::text {

namespace {

// Whether the rest of a word, small letters expected, stands at p; p moves behind it.
bool take_word(const char*& p, const char* word) {
    const char* q = p;
    for (; *word; ++word, ++q)
        if ((*q | 32) != *word) return false;
    p = q;
    return true;
}

}  // namespace

bool read_unusual_float(const char*& p, float& value) {
    const char* q = p;
    const bool negative = *q == '-';
    q += negative || *q == '+';

    if (take_word(q, "inf")) {
        take_word(q, "inity");
        value = negative ? -std::numeric_limits<float>::infinity() : std::numeric_limits<float>::infinity();
        p = q;
        return true;
    }
    if (take_word(q, "nan")) {
        if (*q == '(') {  // nan(ind), nan(0x...)
            const char* r = q + 1;
            while (is_digit(*r) || (*r | 32) == 'x' || ((*r | 32) >= 'a' && (*r | 32) <= 'z')) ++r;
            if (*r == ')') q = r + 1;
        }
        value = std::numeric_limits<float>::quiet_NaN();
        p = q;
        return true;
    }

    std::string number;  // in the spelling from_chars knows
    long magnitude = 0;  // 0.d x 10^magnitude with d's first digit not 0: tells an overflow from an underflow
    bool leading = true;
    int count = 0;
    for (; is_digit(*q); ++q, ++count) {
        number += *q;
        leading &= *q == '0';
        magnitude += !leading;
    }
    if (*q == '.') {
        number += *q++;
        for (; is_digit(*q); ++q, ++count) {
            number += *q;
            magnitude -= leading && *q == '0';
            leading &= *q == '0';
        }
    }
    if (count == 0) return false;
    if (number == "1." && *q == '#' && (q[1] == 'I' || q[1] == 'Q' || q[1] == 'S')) {  // how Microsoft's runtime printed what is no
        // number: 1.#INF, -1.#IND, 1.#QNAN
        while (*q == '#' || is_digit(*q) || ((*q | 32) >= 'a' && (*q | 32) <= 'z')) ++q;
        value = std::numeric_limits<float>::quiet_NaN();
        p = q;
        return true;
    }
    // "e-5", Fortran's "d-5" and "-5", and the slip "-e5".
    const char* r = q;
    bool marked = (*r | 32) == 'e' || (*r | 32) == 'd';
    r += marked;
    const bool signs = *r == '-' || *r == '+';
    const bool minus = *r == '-';
    r += signs;
    if (!marked && signs && (*r | 32) == 'e') ++r;
    if ((marked || signs) && is_digit(*r)) {
        long exponent = 0;
        for (; is_digit(*r); ++r)
            if (exponent < 1000000) exponent = exponent * 10 + (*r - '0');
        magnitude += minus ? -exponent : exponent;
        number += minus ? "e-" : "e";
        number += std::to_string(exponent);
        q = r;
    }
    float f = 0;
    const auto result = std::from_chars(number.data(), number.data() + number.size(), f);
    if (result.ec == std::errc::result_out_of_range) f = magnitude > 0 ? std::numeric_limits<float>::infinity() : 0.0f;
    value = negative ? -f : f;
    p = q;
    return true;
}

}  // namespace relievo::text
