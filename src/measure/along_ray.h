// How far one hit lies behind another along the ray, in texels of the height map.
#pragma once

#include "core/vec.h"

namespace relievo {

// Positive: late, farther along than the true hit. `view_tangent` points from the surface to the eye, so the ray travels along
// -view.xy in UV. Texels need not be square in UV, so the direction is normalised in texels, where the distance is measured.
// A ray along the normal does not move in UV and is never late or early: 0.
inline double texels_along_ray(Vec2d uv, Vec2d true_uv, Vec3d view_tangent, Vec2d texels) {
    const Vec2d travel = Vec2d{-view_tangent.x, -view_tangent.y} * texels;
    const double speed = length(travel);
    if (speed == 0) return 0;
    return dot((uv - true_uv) * texels, travel) / speed;
}

// A hit within half a texel counts as the right one: the texel that is read is then the same or its neighbour's nearer half.
inline constexpr double right_within_texels = 0.5;

}  // namespace relievo
