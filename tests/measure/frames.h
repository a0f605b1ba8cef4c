// Small frames made by hand, for tests of what judges them.
#pragma once

#include "core/frame.h"
#include "core/vec.h"

#include <cstdint>

namespace relievo::test {

inline constexpr auto background = static_cast<std::uint8_t>(Coverage::background);
inline constexpr auto hit = static_cast<std::uint8_t>(Coverage::hit);
inline constexpr auto no_hit = static_cast<std::uint8_t>(Coverage::no_hit);

// Every pixel hits at uv (0.5, 0.5), height 0.5, straight normal, lit, 4 fetches, mid grey.
inline Frame plain_frame(int width, int height) {
    Frame f(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            f.coverage(x, y) = hit;
            f.hit_uv(x, y, 0) = f.hit_uv(x, y, 1) = 0.5f;
            f.hit_height(x, y) = 0.5f;
            f.normal(x, y, 2) = 1;
            f.shadow(x, y) = 1;
            f.fetches(x, y) = 4;
            for (int c = 0; c < 3; ++c) f.colour(x, y, c) = 0.2f;
        }
    }
    return f;
}

// Rays that all meet the base, seen from `view` (surface to eye, need not be of unit length).
inline RayField plain_rays(int width, int height, Vec3d view) {
    RayField r(width, height);
    const Vec3f v(normalize(view));
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            r.coverage(x, y) = hit;
            r.view(x, y, 0) = v.x;
            r.view(x, y, 1) = v.y;
            r.view(x, y, 2) = v.z;
        }
    }
    return r;
}

}  // namespace relievo::test
