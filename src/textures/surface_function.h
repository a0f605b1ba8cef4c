// What a procedural material is before it becomes texels: a height and a colour for every texture coordinate.
#pragma once

#include "core/vec.h"

#include <cstdint>
#include <functional>

namespace relievo {

// How a material is asked for. Features have their size in UV; the spacing of samples only says where fine noise must end and how
// sheer a wall may be drawn.
struct Detail {
    std::uint32_t seed = 1;
    float sample_uv = 1.0f / 1024;  // UV between samples: a texel's width, or less where a texel averages several
};

struct SurfacePoint {
    float height;  // any unit that grows upward: the whole tile is stretched to [0,1] afterwards
    Vec3f colour;  // albedo, sRGB-encoded, [0,1]
};

// Periodic with period 1 in u and v. Called from several threads at once. Only + - * / sqrt and floor are used inside, which
// IEEE 754 rounds the same way everywhere: the library's sin, exp and pow differ from machine to machine.
using SurfaceFunction = std::function<SurfacePoint(Vec2f uv)>;

}  // namespace relievo
