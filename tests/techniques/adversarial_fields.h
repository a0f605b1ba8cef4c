// Height fields made to break searches: what is thinner than a step, steeper than a slope, flatter than a rounding error.
#pragma once

#include "core/height_field.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace relievo::adversarial {

struct Named {
    std::string name;
    HeightField field;
};

inline HeightField filled(int width, int height, const std::function<double(int, int)>& h) {
    HeightField field(width, height);
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) field.texels(i, j) = std::clamp(static_cast<float>(h(i, j)), 0.0f, 1.0f);
    return field;
}

inline void stretch_to_unit(HeightField& field) {
    const auto [low, high] = std::minmax_element(field.texels.texels.begin(), field.texels.texels.end());
    const float base = *low;
    const float range = std::max(*high - base, 1e-6f);
    for (float& h : field.texels.texels) h = std::clamp((h - base) / range, 0.0f, 1.0f);
}

// Periodic value noise in octaves, smoothly interpolated.
inline HeightField fbm(int width, int height, unsigned seed, int octaves = 7) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    HeightField field(width, height);
    double weight = 1;
    for (int octave = 0, n = 4; octave < octaves && n <= std::max(width, height); ++octave, n *= 2, weight *= 0.5) {
        std::vector<double> lattice(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
        for (double& v : lattice) v = uniform(random);
        const auto at = [&](int i, int j) { return lattice[static_cast<std::size_t>((j % n) * n + i % n)]; };
        for (int j = 0; j < height; ++j) {
            for (int i = 0; i < width; ++i) {
                const double x = static_cast<double>(i) * n / width;
                const double y = static_cast<double>(j) * n / height;
                const int x0 = static_cast<int>(x);
                const int y0 = static_cast<int>(y);
                const auto ease = [](double t) { return t * t * (3 - 2 * t); };
                const double fx = ease(x - x0);
                const double fy = ease(y - y0);
                field.texels(i, j) += static_cast<float>(weight * (std::lerp(std::lerp(at(x0, y0), at(x0 + 1, y0), fx),
                                                                             std::lerp(at(x0, y0 + 1), at(x0 + 1, y0 + 1), fx), fy)));
            }
        }
    }
    stretch_to_unit(field);
    return field;
}

// Round stones with sheer joints: the dome over the nearest of jittered lattice points.
inline HeightField cobble(int width, int height, unsigned seed, int stones = 12) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.2, 0.8);
    std::vector<Vec2d> centres;
    std::vector<double> tops;
    for (int k = 0; k < stones * stones; ++k) {
        centres.push_back({uniform(random), uniform(random)});
        tops.push_back(0.5 + 0.6 * uniform(random));
    }
    return filled(width, height, [&](int i, int j) {
        const double x = static_cast<double>(i) * stones / width;
        const double y = static_cast<double>(j) * stones / height;
        double best = 1e9;
        double top = 0;
        for (int dj = -1; dj <= 1; ++dj) {
            for (int di = -1; di <= 1; ++di) {
                const int cx = static_cast<int>(x) + di;
                const int cy = static_cast<int>(y) + dj;
                const auto k = static_cast<std::size_t>(wrap_index(cy, stones) * stones + wrap_index(cx, stones));
                const double d = std::hypot(cx + centres[k].x - x, cy + centres[k].y - y);
                if (d < best) best = d, top = tops[k];
            }
        }
        return best < 0.55 ? top * std::sqrt(1 - best * best / (0.55 * 0.55)) : 0.0;
    });
}

inline HeightField spikes(int width, int height, unsigned seed, double share = 0.004) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    return filled(width, height, [&](int, int) { return uniform(random) < share ? 0.3 + 0.7 * uniform(random) : 0.05 * uniform(random); });
}

inline std::vector<Named> all(int n, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    const double pi = std::numbers::pi;
    std::vector<Named> fields;
    fields.push_back({"fbm", fbm(n, n, seed)});
    fields.push_back({"cobble", cobble(n, n, seed)});
    fields.push_back({"spikes", spikes(n, n, seed)});
    fields.push_back({"ridges", filled(n, n, [&](int i, int j) { return (i + 2 * j) % 16 == 0 || j % 23 == 0 ? 0.9 : 0.1; })});
    fields.push_back({"saddles", filled(n, n, [&](int i, int j) { return (i + j) % 2 == 0 ? 0.8 : 0.2; })});
    fields.push_back({"white noise", filled(n, n, [&](int, int) { return uniform(random); })});
    fields.push_back({"sheer steps", filled(n, n, [&](int i, int j) { return ((i / 13) * 7 + (j / 11) * 5) % 3 == 0 ? 1.0 : 0.0; })});
    fields.push_back({"seam", filled(n, n, [&](int i, int j) { return (i + 0.5 * j) / (1.5 * n); })});
    fields.push_back({"floor", HeightField(n, n, 0.0f)});
    fields.push_back({"constant", HeightField(n, n, 0.5f)});
    fields.push_back({"lid", HeightField(n, n, 1.0f)});
    fields.push_back({"8 bit", filled(n, n, [&](int, int) { return std::floor(uniform(random) * 256) / 255; })});
    HeightField terraces = fbm(n, n, seed + 1, 4);
    for (float& h : terraces.texels.texels) h = std::round(h * 12) / 12;
    fields.push_back({"terraces", terraces});
    fields.push_back({"smooth", filled(n, n, [&](int i, int j) { return 0.5 + 0.25 * (std::sin(2 * pi * i / n) + std::cos(4 * pi * j / n)); })});
    fields.push_back({"not a power of two", fbm(n * 300 / 256, n * 200 / 256 + 1, seed + 2)});
    fields.push_back({"odd spikes", spikes(n + 37, n - 51, seed + 3)});
    fields.push_back({"one row", filled(n, 1, [&](int, int) { return uniform(random); })});
    fields.push_back({"one column", filled(1, n - 1, [&](int, int) { return uniform(random); })});
    return fields;
}

}  // namespace relievo::adversarial
