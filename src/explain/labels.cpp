#include "explain/labels.h"

#include "figure/font.h"

#include <algorithm>
#include <cmath>

namespace relievo {

void Labels::keep_clear_line(Vec2d a, Vec2d b) {
    // A chain of small squares: a long thin box would close off a whole diagonal.
    const int pieces = std::clamp(static_cast<int>(length(b - a) / 5) + 1, 1, 400);
    for (int i = 0; i <= pieces; ++i) {
        const Vec2d p = a + (b - a) * (static_cast<double>(i) / pieces);
        taken_.push_back({p.x - 1.5, p.y - 1.5, p.x + 1.5, p.y + 1.5});
    }
}

void Labels::place(Drawing& drawing, Vec2d point, double distance, const std::string& text, Ink ink, double size, bool must, bool bold) {
    const double width = text_width(text, size, bold), height = cap_height * size;
    struct Side {
        double x, y;
    };
    constexpr Side sides[] = {{1, -1}, {-1, -1}, {0, -1}, {1, 1}, {-1, 1}, {0, 1}, {1, 0}, {-1, 0}};
    double fewest = 1e30;
    Rect best{};
    // Farther out when nothing near is free, for those that must stand.
    for (int ring = 1; ring <= (must ? 5 : 1); ++ring) {
        for (const Side side : sides) {
            const double reach = distance * ring + (ring - 1) * 6;
            const double cx = point.x + side.x * (side.y == 0 ? reach : 0.75 * reach) + side.x * width / 2;
            const double cy = point.y + side.y * (side.x == 0 ? reach : 0.75 * reach) + side.y * height / 2;
            const Rect box{cx - width / 2 - 2, cy - height / 2 - 2, cx + width / 2 + 2, cy + height / 2 + 2};
            if (box.left < room_.left || box.right > room_.right || box.top < room_.top || box.bottom > room_.bottom) continue;
            const double covered = static_cast<double>(std::ranges::count_if(taken_, [&](const Rect& r) { return r.overlaps(box); }));
            if (covered < fewest) {
                fewest = covered;
                best = box;
            }
            if (fewest == 0) break;
        }
        if (fewest == 0) break;
    }
    if (fewest > 1e29 || (fewest > 0 && !must)) return;
    taken_.push_back(best);
    drawing.marks.push_back(Label{.at = {best.left + 2, best.bottom - 2}, .text = text, .ink = ink, .size = size, .anchor = Anchor::start, .bold = bold});
}

}  // namespace relievo
