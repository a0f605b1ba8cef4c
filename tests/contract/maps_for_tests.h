// All maps of a field, made from their definitions (core/map_set.h) by the plainest loop, so that a technique is tested apart
// from the bakers.
#pragma once

#include "core/map_set.h"

#include <algorithm>
#include <cmath>

namespace relievo::contract {

// Normals of the relief at height_scale, the pyramid of maxima, and for every texel the widest cone that holds no other texel.
inline MapSet maps_for(const HeightField& field, float height_scale) {
    const int w = field.width();
    const int h = field.height();
    MapSet maps;
    maps.height = field;

    ImageF normal(w, h, 3);
    for (int j = 0; j < h; ++j) {
        for (int i = 0; i < w; ++i) {
            const float du = (field.wrapped(i + 1, j) - field.wrapped(i - 1, j)) * static_cast<float>(w) / 2;
            const float dv = (field.wrapped(i, j + 1) - field.wrapped(i, j - 1)) * static_cast<float>(h) / 2;
            const Vec3f n = normalize(Vec3f{-height_scale * du, -height_scale * dv, 1});
            normal(i, j, 0) = n.x;
            normal(i, j, 1) = n.y;
            normal(i, j, 2) = n.z;
        }
    }
    maps.normal = {normal};

    int levels = 1;
    while ((1 << (levels - 1)) < std::max(w, h)) ++levels;
    const int padded = 1 << (levels - 1);
    maps.max_pyramid = {.cells_x = w, .cells_y = h, .levels = {}};
    for (int k = 0; k < levels; ++k) {
        ImageF level(padded >> k, padded >> k, 1);
        for (int j = 0; j < h; ++j) {
            for (int i = 0; i < w; ++i) {
                float& node = level(i >> k, j >> k);
                node = std::max(node, std::ranges::max(field.cell(i, j)));
            }
        }
        maps.max_pyramid.levels.push_back(level);
    }

    maps.cone = ImageF(w, h, 2);
    for (int j = 0; j < h; ++j) {
        for (int i = 0; i < w; ++i) {
            const float apex = field.texels(i, j);
            float least = 1;  // squared ratio
            for (int y = 0; y < h; ++y) {
                for (int x = 0; x < w; ++x) {
                    const float rise = field.texels(x, y) - apex;
                    if (rise <= 0) continue;
                    const float du = static_cast<float>(std::min(std::abs(x - i), w - std::abs(x - i))) / static_cast<float>(w);
                    const float dv = static_cast<float>(std::min(std::abs(y - j), h - std::abs(y - j))) / static_cast<float>(h);
                    least = std::min(least, (du * du + dv * dv) / (rise * rise));
                }
            }
            maps.cone(i, j, 0) = apex;
            maps.cone(i, j, 1) = std::sqrt(least);
        }
    }
    return maps;
}

}  // namespace relievo::contract
