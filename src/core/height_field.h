// The declared surface: heights in [0,1] at texel centres, bilinear between them, repeated in both directions.
#pragma once

#include "core/image.h"
#include "core/vec.h"
#include "core/wrap.h"

#include <array>
#include <cmath>

namespace relievo {

struct HeightField {
    ImageF texels;  // one channel; row 0 is v = 0

    HeightField() = default;
    explicit HeightField(ImageF image) : texels(std::move(image)) { assert(texels.channels == 1); }
    HeightField(int width, int height, float fill = 0.0f) : texels(width, height, 1, fill) {}

    int width() const { return texels.width; }
    int height() const { return texels.height; }
    bool empty() const { return texels.empty(); }

    float wrapped(int i, int j) const { return texels(wrap_index(i, width()), wrap_index(j, height())); }

    // The four corners h00, h10, h01, h11 of cell (i, j), whose domain is [i, i+1] x [j, j+1] in units of texel centres.
    std::array<float, 4> cell(int i, int j) const {
        return {wrapped(i, j), wrapped(i + 1, j), wrapped(i, j + 1), wrapped(i + 1, j + 1)};
    }

    // Height at a texture coordinate, in double.
    double sample(Vec2d uv) const {
        const double x = uv.x * width() - 0.5;
        const double y = uv.y * height() - 0.5;
        const double i = std::floor(x);
        const double j = std::floor(y);
        const auto c = cell(static_cast<int>(i), static_cast<int>(j));
        const double fx = x - i;
        const double fy = y - j;
        return (c[0] * (1 - fx) + c[1] * fx) * (1 - fy) + (c[2] * (1 - fx) + c[3] * fx) * fy;
    }
};

}  // namespace relievo
