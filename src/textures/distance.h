// Signed distances (negative inside) to the plain figures that the materials are drawn with.
#pragma once

#include "core/vec.h"
#include "textures/hash.h"

#include <algorithm>
#include <cmath>

namespace relievo {

// To an axis-aligned box about the origin, with its corners rounded by `radius` (inside the given half size).
inline float box_distance(Vec2f p, Vec2f half_size, float radius = 0) {
    const Vec2f q{std::abs(p.x) - half_size.x + radius, std::abs(p.y) - half_size.y + radius};
    return length(Vec2f{std::max(q.x, 0.0f), std::max(q.y, 0.0f)}) + std::min(std::max(q.x, q.y), 0.0f) - radius;
}

// The point of the segment a-b nearest to p.
inline Vec2f nearest_on_segment(Vec2f p, Vec2f a, Vec2f b) {
    const Vec2f ab = b - a;
    const float squared = dot(ab, ab);
    if (squared <= 0) return a;
    return a + ab * std::clamp(dot(p - a, ab) / squared, 0.0f, 1.0f);
}

// To an ellipse about the origin; first order (f / |grad f| of the implicit form), exact on the outline.
inline float ellipse_distance(Vec2f p, Vec2f radii) {
    const Vec2f q = p / radii;
    const Vec2f g = q / radii;
    const float slope = length(g);
    const float level = length(q);
    return slope > 0 ? (level - 1) * level / slope : -std::min(radii.x, radii.y);
}

// The shortest way from a to b on the unit torus, each component in [-1/2, 1/2].
inline Vec2f torus_offset(Vec2f a, Vec2f b) {
    const Vec2f d = b - a;
    return {d.x - static_cast<float>(floor_index(d.x + 0.5f)), d.y - static_cast<float>(floor_index(d.y + 0.5f))};
}

}  // namespace relievo
