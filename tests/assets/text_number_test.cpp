// Numbers of mesh files against strtof, which rounds correctly.
#include "assets/text_number.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

namespace relievo::text {
namespace {

// The value of the text, and whether exactly `expected_length` bytes of it were taken.
float value_of(const std::string& number, std::size_t expected_length) {
    const std::string line = number + "\n";
    const char* p = line.data();
    float value = -12345;
    EXPECT_TRUE(read_float(p, line.data() + line.size(), value)) << number;
    EXPECT_EQ(static_cast<std::size_t>(p - line.data()), expected_length) << number;
    return value;
}
float value_of(const std::string& number) { return value_of(number, number.size()); }

void expect_as_strtof(const std::string& number) {
    const float expected = std::strtof(number.c_str(), nullptr), got = value_of(number);
    EXPECT_EQ(std::bit_cast<std::uint32_t>(got), std::bit_cast<std::uint32_t>(expected)) << number << " gave " << got << ", expected " << expected;
}

TEST(TextNumber, rounds_as_strtof_does_however_the_number_is_written) {
    std::mt19937_64 random(11);
    std::array<char, 64> text;
    for (int i = 0; i < 60000; ++i) {
        const auto bits = static_cast<std::uint32_t>(random());
        const float any = std::bit_cast<float>(bits);
        if (!std::isfinite(any)) continue;
        const double near = std::ldexp(static_cast<double>(random() >> 11), -53) * 200 - 100;
        const int digits = 1 + static_cast<int>(random() % 12);
        std::snprintf(text.data(), text.size(), "%.*g", digits, static_cast<double>(any));
        expect_as_strtof(text.data());
        std::snprintf(text.data(), text.size(), "%.*f", digits, near);
        expect_as_strtof(text.data());
        std::snprintf(text.data(), text.size(), "%.*e", digits + 8, near);
        expect_as_strtof(text.data());
    }
}

// Halfway between two floats, and one unit of the last decimal place to either side: where rounding twice would go wrong.
TEST(TextNumber, rounds_correctly_at_and_beside_the_middle_of_two_floats) {
    std::mt19937_64 random(12);
    std::array<char, 80> text;
    for (int i = 0; i < 20000; ++i) {
        const float low = static_cast<float>(random() >> 40) / static_cast<float>(1 << (random() % 20));
        const double middle = (static_cast<double>(low) + static_cast<double>(std::nextafter(low, INFINITY))) / 2;
        std::snprintf(text.data(), text.size(), "%.25f", middle);  // exact
        const std::string exact = text.data();
        expect_as_strtof(exact);
        expect_as_strtof(exact + "1");
        std::snprintf(text.data(), text.size(), "%.14g", middle);
        expect_as_strtof(text.data());
    }
}

TEST(TextNumber, limits) {
    for (const char* number : {"0", "-0", "0.0", "-0.0e0", "1.17549435e-38", "1.1754942e-38", "1e-45", "7e-46", "1e-400", "3.4028235e38", "3.4028236e38", "1e39", "-1e39", "1e400",
                               "0.00000000000000000000000000000000000000000000000000001e60", "123456789012345678901234567890", "9007199254740993", "00000000000000000000000012.5",
                               "16777217", "33554435", "0.1", "1e22", "1e23", "8.5e-23"})
        expect_as_strtof(number);
    EXPECT_EQ(value_of("1e-99999999999999999999"), 0.0f);
    EXPECT_EQ(value_of("1e99999999999999999999"), INFINITY);
    EXPECT_EQ(value_of("0e99999"), 0.0f);
}

TEST(TextNumber, unusual_spellings) {
    EXPECT_EQ(value_of("+1"), 1.0f);
    EXPECT_EQ(value_of("2."), 2.0f);
    EXPECT_EQ(value_of("-.5"), -0.5f);
    EXPECT_EQ(value_of("1d3"), 1000.0f);    // Fortran
    EXPECT_EQ(value_of("1.5-2"), 0.015f);
    EXPECT_EQ(value_of("3.1+e2"), 310.0f);  // a slip that is found in files
    EXPECT_EQ(value_of("inf"), INFINITY);
    EXPECT_EQ(value_of("-Infinity"), -INFINITY);
    for (const char* number : {"nan", "NaN", "-nan(ind)", "1.#QNAN", "-1.#IND", "1.#INF"}) EXPECT_FALSE(std::isfinite(value_of(number))) << number;
}

TEST(TextNumber, stops_where_the_number_does) {
    EXPECT_EQ(value_of("1.5/2", 3), 1.5f);
    EXPECT_EQ(value_of("0#red", 1), 0.0f);
    EXPECT_EQ(value_of("12,5", 2), 12.0f);
    EXPECT_EQ(value_of("1e", 1), 1.0f);
    for (const char* none : {"", "-", "+.", ".", "e5", "x", "/1", "--1"}) {
        const std::string line = std::string(none) + "\n";
        const char* p = line.data();
        float value = 0;
        EXPECT_FALSE(read_float(p, line.data() + line.size(), value)) << none;
        EXPECT_EQ(p, line.data());
    }
}

TEST(TextNumber, integers_stop_growing) {
    const auto read = [](const std::string& text, std::int64_t& value) {
        const std::string line = text + "\n";
        const char* p = line.data();
        return read_integer(p, value);
    };
    std::int64_t value = 0;
    EXPECT_TRUE(read("-17", value));
    EXPECT_EQ(value, -17);
    EXPECT_TRUE(read("99999999999999999999999999", value));
    EXPECT_EQ(value, std::int64_t{1} << 40);
    EXPECT_FALSE(read("-", value));
}

}  // namespace
}  // namespace relievo::text
