#include "figure/raster.h"

#include "figure/font.h"
#include "figure/ink.h"

#include <algorithm>
#include <cmath>

namespace relievo {

namespace {

// Share of each pixel that a shape covers, over a rectangle of pixels.
struct Coverage {
    int x0 = 0, y0 = 0, width = 0, height = 0;
    std::vector<double> share;

    Coverage(const std::vector<std::vector<Vec2d>>& contours, double margin, int picture_width, int picture_height) {
        double left = 1e30, right = -1e30, top = 1e30, bottom = -1e30;
        for (const auto& contour : contours)
            for (const Vec2d p : contour) {
                left = std::min(left, p.x), right = std::max(right, p.x);
                top = std::min(top, p.y), bottom = std::max(bottom, p.y);
            }
        if (left > right) return;
        // Clamped before they become integers: a mark may lie anywhere.
        const auto pixel = [](double v, int size) { return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(size))); };
        x0 = pixel(std::floor(left - margin), picture_width);
        y0 = pixel(std::floor(top - margin), picture_height);
        width = pixel(std::ceil(right + margin), picture_width) - x0;
        height = pixel(std::ceil(bottom + margin), picture_height) - y0;
        share.assign(static_cast<std::size_t>(std::max(width, 0)) * static_cast<std::size_t>(std::max(height, 0)), 0.0);
    }
    bool empty() const { return share.empty(); }
    double& at(int x, int y) { return share[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]; }
};

// Areas by signed trapezoids: each edge adds, to every pixel at its right, the area between them, so that one sum along a row gives
// the exact coverage (Levien 2016, "Inside the fastest font renderer in the world"). Contours that overlap in one direction count
// once.
Coverage filled(const std::vector<std::vector<Vec2d>>& contours, int picture_width, int picture_height) {
    Coverage c(contours, 1, picture_width, picture_height);
    if (c.empty()) return c;
    for (const auto& contour : contours) {
        for (std::size_t i = 0; i < contour.size(); ++i) {
            Vec2d a = contour[i] - Vec2d(c.x0, c.y0);
            Vec2d b = contour[(i + 1) % contour.size()] - Vec2d(c.x0, c.y0);
            if (a.y == b.y) continue;
            const double sign = a.y < b.y ? 1 : -1;
            if (a.y > b.y) std::swap(a, b);
            const double slope = (b.x - a.x) / (b.y - a.y);
            const int first = std::max(0, static_cast<int>(std::floor(a.y)));
            for (int y = first; y < c.height && y < b.y; ++y) {
                const double from = std::max(a.y, static_cast<double>(y)), to = std::min(b.y, static_cast<double>(y + 1));
                double left = a.x + slope * (from - a.y), right = a.x + slope * (to - a.y);
                const double dy = sign * (to - from);
                if (left > right) std::swap(left, right);
                const double span = right - left;
                // What lies left of the rectangle counts at its border, what lies right of it nowhere.
                const double outside = span > 0 ? std::clamp(-left / span, 0.0, 1.0) : left < 0 ? 1.0 : 0.0;
                c.at(0, y) += dy * outside;
                for (int x = std::max(0, static_cast<int>(left)); x < c.width && x <= right; ++x) {
                    const double l = std::max(left, static_cast<double>(x)), r = std::min(right, static_cast<double>(x + 1));
                    const double part = span > 0 ? dy * std::max(0.0, r - l) / span : dy * (1 - outside);
                    const double inside = part * (static_cast<double>(x + 1) - (l + r) / 2);
                    c.at(x, y) += inside;
                    if (x + 1 < c.width) c.at(x + 1, y) += part - inside;
                    if (span == 0) break;
                }
            }
        }
    }
    for (int y = 0; y < c.height; ++y) {
        double sum = 0;
        for (int x = 0; x < c.width; ++x) {
            sum += c.at(x, y);
            c.at(x, y) = std::min(std::abs(sum), 1.0);
        }
    }
    return c;
}

// Lines by distance: round ends and joints, and no pixel counted twice where pieces meet.
Coverage stroked(const std::vector<Vec2d>& points, bool closed, double width, int picture_width, int picture_height) {
    const double radius = width / 2;
    Coverage c({points}, radius + 1, picture_width, picture_height);
    if (c.empty()) return c;
    const std::size_t pieces = closed ? points.size() : points.size() - 1;
    for (std::size_t i = 0; i < pieces; ++i) {
        const Vec2d a = points[i] - Vec2d(c.x0, c.y0);
        const Vec2d b = points[(i + 1) % points.size()] - Vec2d(c.x0, c.y0);
        const Vec2d along = b - a;
        const double squared = dot(along, along);
        const auto bound = [](double v, int size) { return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(size))); };
        const int y_from = bound(std::floor(std::min(a.y, b.y) - radius - 1), c.height), y_to = bound(std::ceil(std::max(a.y, b.y) + radius + 1), c.height);
        for (int y = y_from; y < y_to; ++y) {
            // The columns that the piece comes near in this row.
            double left = std::min(a.x, b.x), right = std::max(a.x, b.x);
            if (std::abs(along.y) > 1e-9) {
                const double t0 = std::clamp((y - radius - 1 - a.y) / along.y, 0.0, 1.0), t1 = std::clamp((y + 2 + radius - a.y) / along.y, 0.0, 1.0);
                left = std::min(a.x + t0 * along.x, a.x + t1 * along.x), right = std::max(a.x + t0 * along.x, a.x + t1 * along.x);
            }
            const int x_from = bound(std::floor(left - radius - 1), c.width), x_to = bound(std::ceil(right + radius + 1), c.width);
            for (int x = x_from; x < x_to; ++x) {
                const Vec2d p{x + 0.5, y + 0.5};
                const double t = squared > 0 ? std::clamp(dot(p - a, along) / squared, 0.0, 1.0) : 0.0;
                // Thinner than a pixel: fainter, not thinner.
                const double near = std::min(1.0, std::max(radius, 0.5) + 0.5 - length(p - a - along * t));
                c.at(x, y) = std::max(c.at(x, y), near * std::min(1.0, width));
            }
        }
    }
    return c;
}

// A line cut into dashes.
std::vector<std::vector<Vec2d>> dashes(const std::vector<Vec2d>& points, double on, double off) {
    std::vector<std::vector<Vec2d>> result;
    double left = on;
    bool drawing = true;
    if (points.empty()) return result;
    result.push_back({points.front()});
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        Vec2d at = points[i];
        double rest = length(points[i + 1] - at);
        const Vec2d step = rest > 0 ? (points[i + 1] - at) / rest : Vec2d{};
        while (rest > left) {
            at += step * left;
            rest -= left;
            if (drawing) result.back().push_back(at);
            drawing = !drawing;
            left = drawing ? on : off;
            if (drawing) result.push_back({at});
        }
        left -= rest;
        if (drawing) result.back().push_back(points[i + 1]);
    }
    return result;
}

std::vector<Vec2d> circle(Vec2d centre, double radius) {
    const int pieces = std::clamp(static_cast<int>(8 + 2 * radius), 16, 256);
    std::vector<Vec2d> points;
    for (int i = 0; i < pieces; ++i) {
        const double angle = 2 * 3.14159265358979323846 * i / pieces;
        points.push_back(centre + Vec2d{std::cos(angle), std::sin(angle)} * radius);
    }
    return points;
}

class Painter {
public:
    Painter(const Drawing& drawing, Paper paper, double scale)
        : dark_(paper == Paper::dark), scale_(scale),
          picture_(static_cast<int>(std::ceil(drawing.width * scale)), static_cast<int>(std::ceil(drawing.height * scale)), 3) {
        const Rgb8 ground = colour(Ink::paper);
        for (std::size_t i = 0; i < picture_.texels.size(); ++i) picture_.texels[i] = ground[i % 3];
    }

    void operator()(const Path& path) {
        std::vector<Vec2d> points;
        for (const Vec2d p : path.points) points.push_back(p * scale_);
        if (points.empty()) return;
        if (path.fill > 0) blend(filled({points}, picture_.width, picture_.height), path.ink, path.fill);
        if (path.width <= 0) return;
        if (!path.dashed) return blend(stroked(points, path.closed, path.width * scale_, picture_.width, picture_.height), path.ink, path.opacity);
        if (path.closed) points.push_back(points.front());
        for (const auto& dash : dashes(points, dash_length * scale_, dash_gap * scale_))
            blend(stroked(dash, false, path.width * scale_, picture_.width, picture_.height), path.ink, path.opacity);
    }
    void operator()(const Dot& dot) {
        // A line of this width around the circle, its middle on it, as SVG draws it.
        const auto outer = circle(dot.centre * scale_, (dot.radius + dot.width / 2) * scale_);
        const auto inner = circle(dot.centre * scale_, std::max(0.0, dot.radius - dot.width / 2) * scale_);
        blend(filled({outer}, picture_.width, picture_.height), dot.hollow ? dot.ink : Ink::paper, 1);
        blend(filled({inner}, picture_.width, picture_.height), dot.hollow ? Ink::paper : dot.ink, 1);
    }
    void operator()(const Label& label) {
        const double width = text_width(label.text, label.size * scale_, label.bold);
        const double shift = label.anchor == Anchor::middle ? width / 2 : label.anchor == Anchor::end ? width : 0;
        // Base lines on whole pixels keep letters crisp.
        const Vec2d at{label.at.x * scale_ - shift, std::round(label.at.y * scale_)};
        auto contours = text_outlines(label.text, label.size * scale_, label.bold);
        for (auto& contour : contours)
            for (Vec2d& p : contour) p += at;
        blend(filled(contours, picture_.width, picture_.height), label.ink, 1);
    }

    Image8 take() { return std::move(picture_); }

private:
    Rgb8 colour(Ink ink) const { return dark_ ? ink_colour(ink).dark : ink_colour(ink).light; }

    // In sRGB values, as browsers do, so that PNG and SVG look alike.
    void blend(Coverage cover, Ink ink, double opacity) {
        const Rgb8 over = colour(ink);
        for (int y = 0; y < cover.height; ++y)
            for (int x = 0; x < cover.width; ++x) {
                const double share = cover.at(x, y) * opacity;
                if (share <= 0) continue;
                for (int c = 0; c < 3; ++c) {
                    std::uint8_t& under = picture_(cover.x0 + x, cover.y0 + y, c);
                    under = static_cast<std::uint8_t>(std::lround(under + (over[static_cast<std::size_t>(c)] - under) * share));
                }
            }
    }

    bool dark_;
    double scale_;
    Image8 picture_;
};

}  // namespace

Image8 raster(const Drawing& drawing, Paper paper, double scale) {
    Painter painter(drawing, paper, scale);
    for (const Mark& mark : drawing.marks) std::visit(painter, mark);
    return painter.take();
}

}  // namespace relievo
