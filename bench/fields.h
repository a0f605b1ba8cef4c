// Fields on which baking is timed, and the clock: what benchmarks of maps share.
#pragma once

#include "core/height_field.h"
#include "core/parallel_for.h"
#include "core/wrap.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <numbers>
#include <vector>

namespace relievo::bench {

inline std::uint32_t hash(std::uint32_t x, std::uint32_t y, std::uint32_t seed) {
    std::uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ seed * 0xc2b2ae3du;
    h = (h ^ (h >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    return h ^ (h >> 15);
}
inline float unit_random(int x, int y, std::uint32_t seed) {
    return static_cast<float>(hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), seed) >> 8) * 0x1p-24f;
}

// Value noise of `cells` cells per period.
inline float noise(float u, float v, int cells, std::uint32_t seed) {
    const float x = u * static_cast<float>(cells);
    const float y = v * static_cast<float>(cells);
    const int i = static_cast<int>(x);
    const int j = static_cast<int>(y);
    float fx = x - static_cast<float>(i);
    float fy = y - static_cast<float>(j);
    fx = fx * fx * (3 - 2 * fx);
    fy = fy * fy * (3 - 2 * fy);
    const auto corner = [&](int a, int b) { return unit_random(wrap_index(i + a, cells), wrap_index(j + b, cells), seed); };
    return std::lerp(std::lerp(corner(0, 0), corner(1, 0), fx), std::lerp(corner(0, 1), corner(1, 1), fx), fy);
}

inline float fbm(float u, float v, int) {
    float h = 0;
    for (int octave = 0; octave < 8; ++octave) h += noise(u, v, 4 << octave, static_cast<std::uint32_t>(octave)) / static_cast<float>(2 << octave);
    return std::clamp(h, 0.0f, 1.0f);
}

inline float cobbles(float u, float v, int) {
    constexpr int cells = 12;
    const float x = u * cells;
    const float y = v * cells;
    float nearest = 9;
    float second = 9;
    for (int b = -2; b <= 2; ++b)
        for (int a = -2; a <= 2; ++a) {
            const int i = static_cast<int>(x) + a;
            const int j = static_cast<int>(y) + b;
            const float px = static_cast<float>(i) + unit_random(wrap_index(i, cells), wrap_index(j, cells), 1);
            const float py = static_cast<float>(j) + unit_random(wrap_index(i, cells), wrap_index(j, cells), 2);
            const float d = std::hypot(x - px, y - py);
            second = std::min(second, std::max(nearest, d));
            nearest = std::min(nearest, d);
        }
    const float edge = std::min(1.0f, 2.5f * (second - nearest));
    return std::clamp(std::sqrt(edge) * 0.9f + 0.1f * noise(u, v, 128, 3), 0.0f, 1.0f);
}

// A spike one texel wide in about one of 400 texels, on a low rough floor.
inline float spikes(float u, float v, int size) {
    const int i = static_cast<int>(u * static_cast<float>(size));
    const int j = static_cast<int>(v * static_cast<float>(size));
    const bool spike = unit_random(i, j, 5) < 1.0f / 400;
    return spike ? 0.5f + 0.5f * unit_random(i, j, 6) : 0.1f * unit_random(i, j, 7);
}

inline float flat(float, float, int) { return 0.5f; }

// Sheer terraces: eight exact levels, large areas of equal texels.
inline float steps(float u, float v, int) { return std::floor(8 * std::min(0.999f, 1.4f * noise(u, v, 8, 9))) / 7; }

// Engraved letters, more or less: a flat top, deep narrow grooves.
inline float grooves(float u, float v, int) {
    const float wave = std::sin(2 * std::numbers::pi_v<float> * (6 * u + 2 * noise(u, v, 5, 4)));
    return std::abs(wave) < 0.15f ? 0.0f : 1.0f;
}

inline HeightField make(float (*shape)(float, float, int), int size) {
    HeightField field(size, size);
    parallel_for(size, 8, 0, [&](int begin, int end) {
        for (int j = begin; j < end; ++j)
            for (int i = 0; i < size; ++i)
                field.texels(i, j) = shape((static_cast<float>(i) + 0.5f) / static_cast<float>(size),
                                           (static_cast<float>(j) + 0.5f) / static_cast<float>(size), size);
    });
    return field;
}

inline double seconds_of(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Of all threads of this process: what other programs do meanwhile counts for little.
inline double processor_seconds_of(const auto& work) {
    const std::clock_t start = std::clock();
    work();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

inline double median(std::vector<double> times) {
    std::ranges::nth_element(times, times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2));
    return times[times.size() / 2];
}

}  // namespace relievo::bench
