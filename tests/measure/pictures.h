// Pictures made by a formula or at random, for tests of what compares pictures.
#pragma once

#include "core/image.h"
#include "core/vec.h"

#include <functional>
#include <random>

namespace relievo::test {

inline ImageF painted(int width, int height, const std::function<Vec3f(int, int)>& f) {
    ImageF image(width, height, 3);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const Vec3f c = f(x, y);
            image(x, y, 0) = c.x;
            image(x, y, 1) = c.y;
            image(x, y, 2) = c.z;
        }
    }
    return image;
}

inline ImageF uniform(int width, int height, Vec3f colour) {
    return painted(width, height, [&](int, int) { return colour; });
}

inline ImageF random_picture(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    ImageF image(width, height, 3);
    for (float& v : image.texels) v = unit(random);
    return image;
}

}  // namespace relievo::test
