// A small material made by hand, maps included, by the plainest possible code: domes, a step, a ramp and an asymmetric mark.
#pragma once

#include "core/map_set.h"
#include "maps/map_kinds.h"

#include <algorithm>
#include <cmath>

namespace relievo::test {

// Eight-by-eight picture of the letter F, its bottom row first, as memory rows are (row 0 is v = 0).
inline bool letter_f(float u, float v) {
    constexpr const char* rows[] = {"........", ".#......", ".#......", ".####...", ".#......", ".######.", ".######.", "........"};
    return rows[std::clamp(static_cast<int>(v * 8), 0, 7)][std::clamp(static_cast<int>(u * 8), 0, 7)] == '#';
}

// Heights in [0.05, 1): a dome per quarter but the last, which holds a plateau with sheer walls; smooth waves under all.
inline HeightField small_height(int size) {
    HeightField field(size, size);
    for (int j = 0; j < size; ++j) {
        for (int i = 0; i < size; ++i) {
            const float u = (static_cast<float>(i) + 0.5f) / static_cast<float>(size);
            const float v = (static_cast<float>(j) + 0.5f) / static_cast<float>(size);
            float h = 0.15f + 0.05f * std::sin(6.2831853f * 3 * u) * std::cos(6.2831853f * 2 * v) + 0.05f * u;
            const float x = std::fmod(u, 0.5f) - 0.25f;
            const float y = std::fmod(v, 0.5f) - 0.25f;
            if (u > 0.5f && v > 0.5f) {
                if (std::abs(x) < 0.13f && std::abs(y) < 0.13f) h = 0.9f;
            } else {
                const float d = (x * x + y * y) / (0.2f * 0.2f);
                if (d < 1) h = std::max(h, 0.97f * std::sqrt(1 - d));
            }
            field.texels(i, j) = h;
        }
    }
    return field;
}

// Mip chain by averaging 2x2, for sizes that are powers of two.
template <class T>
std::vector<Image<T>> halved_chain(Image<T> finest, bool unit_vectors) {
    std::vector<Image<T>> chain{std::move(finest)};
    while (chain.back().width > 1 || chain.back().height > 1) {
        const Image<T>& fine = chain.back();
        Image<T> coarse(std::max(1, fine.width / 2), std::max(1, fine.height / 2), fine.channels);
        for (int y = 0; y < coarse.height; ++y) {
            for (int x = 0; x < coarse.width; ++x) {
                float sum[4] = {};
                for (int c = 0; c < fine.channels; ++c)
                    for (int k = 0; k < 4; ++k)
                        sum[c] += 0.25f * static_cast<float>(fine(std::min(2 * x + k % 2, fine.width - 1),
                                                                  std::min(2 * y + k / 2, fine.height - 1), c));
                const float length = unit_vectors ? std::sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) : 1;
                for (int c = 0; c < fine.channels; ++c) coarse(x, y, c) = static_cast<T>(sum[c] / length);
            }
        }
        chain.push_back(std::move(coarse));
    }
    return chain;
}

inline ImageF central_difference_normals(const HeightField& field, float height_scale) {
    ImageF normals(field.width(), field.height(), 3);
    for (int j = 0; j < field.height(); ++j) {
        for (int i = 0; i < field.width(); ++i) {
            const float du = 0.5f * static_cast<float>(field.width()) * (field.wrapped(i + 1, j) - field.wrapped(i - 1, j));
            const float dv = 0.5f * static_cast<float>(field.height()) * (field.wrapped(i, j + 1) - field.wrapped(i, j - 1));
            const Vec3f n = normalize(Vec3f{-height_scale * du, -height_scale * dv, 1});
            normals(i, j, 0) = n.x;
            normals(i, j, 1) = n.y;
            normals(i, j, 2) = n.z;
        }
    }
    return normals;
}

// Square fields whose size is a power of two need no padding.
inline MaxPyramid brute_force_pyramid(const HeightField& field) {
    MaxPyramid pyramid{field.width(), field.height(), {}};
    for (int size = field.width(); size >= 1; size /= 2) {
        ImageF level(size, size, 1);
        const int edge = field.width() / size;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                for (int j = y * edge; j <= (y + 1) * edge; ++j)
                    for (int i = x * edge; i <= (x + 1) * edge; ++i) level(x, y) = std::max(level(x, y), field.wrapped(i, j));
        pyramid.levels.push_back(std::move(level));
    }
    return pyramid;
}

// For each texel the largest c <= 1 such that no texel within one period stands inside the cone r < c * (height above it).
inline ImageF brute_force_cones(const HeightField& field) {
    const int n = field.width();
    ImageF cones(n, n, 2);
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const float h = field.texels(i, j);
            float ratio = 1;
            for (int y = -n / 2; y <= n / 2; ++y) {
                for (int x = -n / 2; x <= n / 2; ++x) {
                    const float rise = field.wrapped(i + x, j + y) - h;
                    if (rise > 0)
                        ratio = std::min(ratio, std::sqrt(static_cast<float>(x * x + y * y)) / static_cast<float>(n) / rise);
                }
            }
            cones(i, j, 0) = h;
            cones(i, j, 1) = ratio;
        }
    }
    return cones;
}

inline MapSet small_maps(int size, float height_scale) {
    MapSet maps;
    maps.height = small_height(size);
    maps.normal = halved_chain(central_difference_normals(maps.height, height_scale), true);
    Image8 colour(size, size, 4);
    for (int j = 0; j < size; ++j) {
        for (int i = 0; i < size; ++i) {
            const bool mark = letter_f((static_cast<float>(i) + 0.5f) / static_cast<float>(size),
                                       (static_cast<float>(j) + 0.5f) / static_cast<float>(size));
            const std::uint8_t texel[] = {static_cast<std::uint8_t>(mark ? 200 : 170), static_cast<std::uint8_t>(mark ? 60 : 165),
                                          static_cast<std::uint8_t>(mark ? 50 : 150), 255};
            std::copy_n(texel, 4, colour.at(i, j));
        }
    }
    maps.colour = halved_chain(std::move(colour), false);
    maps.max_pyramid = brute_force_pyramid(maps.height);
    maps.cone = brute_force_cones(maps.height);
    // The rest, whose definitions have tests of their own, from the program's bakers.
    for (const MapKind& kind : map_kinds())
        if (kind.bake != nullptr && kind.image != nullptr && (maps.*kind.image).empty())
            kind.bake(maps, {.height_scale = height_scale, .threads = 0, .progress = {}});
    return maps;
}

}  // namespace relievo::test
