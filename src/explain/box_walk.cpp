#include "explain/box_walk.h"

#include "core/wrap.h"
#include "explain/search.h"

#include <algorithm>
#include <cmath>

namespace relievo {

namespace {

// Stretch of x over which one coordinate lies in [low, high].
BoxSpan inside(double at, double step, double low, double high) {
    if (std::abs(step) < 1e-12) return {-1e30, 1e30};
    const double a = (low - at) / step, b = (high - at) / step;
    return {std::min(a, b), std::max(a, b)};
}

}  // namespace

BoxWalk::BoxWalk(const Section& section, int width, int height) {
    const Vec2d size{static_cast<double>(width), static_cast<double>(height)};
    at_entry_ = section.entry_uv * size - Vec2d(0.5, 0.5);
    step_ = section.uv_per_texel * size;
    const double end = 1 / section.drop_per_texel;
    // From cell to cell (Amanatides and Woo 1987). A ray flatter than a hundred thousand cells would only fill the memory.
    const Vec2i first{static_cast<int>(std::floor(at_entry_.x)), static_cast<int>(std::floor(at_entry_.y))};
    Vec2i cell = first;
    double x = 0;
    while (x < end && crossed_.size() < 100000) {
        const BoxSpan u = inside(at_entry_.x, step_.x, cell.x, cell.x + 1), v = inside(at_entry_.y, step_.y, cell.y, cell.y + 1);
        const double leave = std::max(x, std::min(u.leave, v.leave));
        crossed_.push_back({{wrap_index(cell.x, width), wrap_index(cell.y, height)}, cell - first, x, std::min(leave, end)});
        if (u.leave <= v.leave) {
            cell.x += step_.x > 0 ? 1 : -1;
        } else {
            cell.y += step_.y > 0 ? 1 : -1;
        }
        x = leave;
    }
}

BoxSpan BoxWalk::node(Vec2i index, int level) {
    const auto holds = [&](const Crossed& c) { return c.cell.x >> level == index.x && c.cell.y >> level == index.y; };
    // The search may have come on inside an opened node, so look ahead first and then behind.
    std::size_t first = come_;
    while (first < crossed_.size() && !holds(crossed_[first])) ++first;
    if (first == crossed_.size()) {
        first = come_;
        while (first > 0 && !holds(crossed_[first])) --first;
    }
    if (!holds(crossed_[first])) return {crossed_[come_].enter, crossed_[come_].leave};
    std::size_t last = first;
    while (last + 1 < crossed_.size() && holds(crossed_[last + 1])) ++last;
    while (first > 0 && holds(crossed_[first - 1])) --first;
    come_ = first;
    return {crossed_[first].enter, crossed_[last].leave};
}

BoxSpan BoxWalk::ahead(int reach) const {
    const auto within = [&](const Crossed& c) {
        const Vec2i d = c.moved - crossed_[come_].moved;
        return std::abs(d.x) <= reach && std::abs(d.y) <= reach;
    };
    std::size_t last = come_;
    while (last + 1 < crossed_.size() && within(crossed_[last + 1])) ++last;
    return {crossed_[come_].enter, crossed_[last].leave};
}

}  // namespace relievo
