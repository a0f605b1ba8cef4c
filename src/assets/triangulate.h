// Polygons cut into triangles.
#pragma once

#include "core/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relievo {

// Appends three corner numbers (0 .. n-1) per triangle, n - 2 triangles in the polygon's orientation, and returns whether the cut
// is clean. Polygons that are convex are cut as a fan from corner 0; others, seen along their mean normal (Newell), by clipping
// ears (Meisters, "Polygons have ears", 1975). Where no ear is left, because the outline crosses itself or has no area, or where a
// polygon of thousands of corners keeps ears rare, what remains is cut as a fan and the answer is false.
// n >= 3; positions finite.
bool triangulate(std::span<const Vec3f> polygon, std::vector<std::uint32_t>& triangles);

}  // namespace relievo
