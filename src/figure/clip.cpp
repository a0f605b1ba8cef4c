#include "figure/clip.h"

#include <algorithm>

namespace relievo {

std::vector<Vec2d> clipped_area(std::vector<Vec2d> polygon, const Rect& to) {
    // Depth inside each side; negative is outside.
    const auto depth = [&](Vec2d p, int side) {
        switch (side) {
            case 0: return p.x - to.left;
            case 1: return to.right - p.x;
            case 2: return p.y - to.top;
            default: return to.bottom - p.y;
        }
    };
    for (int side = 0; side < 4 && !polygon.empty(); ++side) {
        std::vector<Vec2d> kept;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Vec2d a = polygon[i], b = polygon[(i + 1) % polygon.size()];
            const double da = depth(a, side), db = depth(b, side);
            if (da >= 0) kept.push_back(a);
            if ((da >= 0) != (db >= 0)) kept.push_back(a + (b - a) * (da / (da - db)));
        }
        polygon = std::move(kept);
    }
    return polygon;
}

std::vector<std::vector<Vec2d>> clipped_line(const std::vector<Vec2d>& line, const Rect& to) {
    std::vector<std::vector<Vec2d>> parts;
    bool joined = false;  // the last part goes on at the next piece
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Vec2d a = line[i], d = line[i + 1] - a;
        double enter = 0, leave = 1;
        bool outside = false;
        const auto cut = [&](double toward, double room) {  // toward: speed out of a side; room: distance to it
            if (toward == 0) {
                outside = outside || room < 0;
            } else if (toward > 0) {
                leave = std::min(leave, room / toward);
            } else {
                enter = std::max(enter, room / toward);
            }
        };
        cut(-d.x, a.x - to.left), cut(d.x, to.right - a.x), cut(-d.y, a.y - to.top), cut(d.y, to.bottom - a.y);
        if (outside || enter > leave) {
            joined = false;
            continue;
        }
        if (!joined || enter > 0) parts.push_back({a + d * enter});
        parts.back().push_back(a + d * leave);
        joined = leave >= 1;
    }
    return parts;
}

}  // namespace relievo
