// Marks cut off at the edges of a panel, so that no writer needs to know of clipping.
#pragma once

#include "core/vec.h"

#include <vector>

namespace relievo {

struct Rect {
    double left = 0, top = 0, right = 0, bottom = 0;
    double width() const { return right - left; }
    double height() const { return bottom - top; }
    bool contains(Vec2d p) const { return p.x >= left && p.x <= right && p.y >= top && p.y <= bottom; }
    bool overlaps(const Rect& o) const { return left < o.right && o.left < right && top < o.bottom && o.top < bottom; }
};

// The part of a closed polygon inside the rectangle (Sutherland and Hodgman 1974); empty where nothing is.
std::vector<Vec2d> clipped_area(std::vector<Vec2d> polygon, const Rect& to);

// The parts of a line inside the rectangle, in order (Liang and Barsky 1984, piece by piece).
std::vector<std::vector<Vec2d>> clipped_line(const std::vector<Vec2d>& line, const Rect& to);

}  // namespace relievo
