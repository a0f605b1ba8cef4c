#include "assets/triangulate.h"

#include <cassert>
#include <cmath>
#include <cstddef>

namespace relievo {

namespace {

// Twice the signed area.
double area(Vec2d a, Vec2d b, Vec2d c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

// Newell's normal (Tampieri, Graphics Gems III, 1992): its length is twice the area, whatever the shape and however flat it is.
Vec3d newell_normal(std::span<const Vec3f> polygon) {
    const Vec3d origin(polygon[0]);
    Vec3d sum(0.0), before = Vec3d(polygon.back()) - origin;
    for (const Vec3f& corner : polygon) {
        const Vec3d here = Vec3d(corner) - origin;
        sum += cross(before, here);
        before = here;
    }
    return sum;
}

// The polygon seen from where its normal points, counter-clockwise: the coordinate along the normal's longest axis is dropped.
std::vector<Vec2d> flattened(std::span<const Vec3f> polygon) {
    const Vec3d n = newell_normal(polygon);
    const Vec3d size(std::abs(n.x), std::abs(n.y), std::abs(n.z));
    std::vector<Vec2d> flat;
    flat.reserve(polygon.size());
    for (const Vec3f& corner : polygon) {
        const Vec3d p(corner);
        if (size.x >= size.y && size.x >= size.z)
            flat.push_back(n.x > 0 ? Vec2d(p.y, p.z) : Vec2d(p.z, p.y));
        else if (size.y >= size.z)
            flat.push_back(n.y > 0 ? Vec2d(p.z, p.x) : Vec2d(p.x, p.z));
        else
            flat.push_back(n.z > 0 ? Vec2d(p.x, p.y) : Vec2d(p.y, p.x));
    }
    return flat;
}

bool contains(Vec2d a, Vec2d b, Vec2d c, Vec2d p) { return area(a, b, p) >= 0 && area(b, c, p) >= 0 && area(c, a, p) >= 0; }

class EarClipper {
public:
    EarClipper(std::span<const Vec3f> polygon, std::vector<std::uint32_t>& triangles)
        : flat_(flattened(polygon)), left_(flat_.size()), before_(flat_.size()), after_(flat_.size()), triangles_(triangles) {
        const auto n = static_cast<std::uint32_t>(flat_.size());
        for (std::uint32_t i = 0; i < n; ++i) {
            before_[i] = i == 0 ? n - 1 : i - 1;
            after_[i] = i + 1 == n ? 0 : i + 1;
        }
        // Points that can lie in an ear: those where the outline turns inwards. Clipping never adds any.
        for (std::uint32_t i = 0; i < n; ++i)
            if (turn(i) <= 0) inward_.push_back(i);
    }

    bool convex() const { return inward_.empty(); }

    bool clip() {
        // Tests allowed per corner: a file of b bytes then costs at most b times this, whatever its polygons look like, and
        // outlines of up to as many corners are always searched to the end.
        constexpr std::size_t tests_per_corner = 2048;
        std::size_t budget = tests_per_corner * flat_.size();
        std::uint32_t at = 0, tried = 0;
        while (left_ > 3) {
            if (tried >= left_ || budget < inward_.size()) {
                fan(at);
                return false;
            }
            budget -= inward_.size();
            if (is_ear(at)) {
                emit(before_[at], at, after_[at]);
                const std::uint32_t last = before_[at], next = after_[at];
                after_[last] = next;
                before_[next] = last;
                before_[at] = gone;
                --left_;
                drop_straightened();
                // Not `next`: that would cut everything as a fan of needles from one corner.
                at = after_[next];
                tried = 0;
            } else {
                at = after_[at];
                ++tried;
            }
        }
        emit(before_[at], at, after_[at]);
        return true;
    }

private:
    static constexpr std::uint32_t gone = 0xffffffff;

    double turn(std::uint32_t i) const { return area(flat_[before_[i]], flat_[i], flat_[after_[i]]); }

    bool is_ear(std::uint32_t i) const {
        const Vec2d a = flat_[before_[i]], b = flat_[i], c = flat_[after_[i]];
        if (!(area(a, b, c) > 0)) return false;
        for (const std::uint32_t j : inward_) {
            const Vec2d p = flat_[j];
            if (j == before_[i] || j == i || j == after_[i] || p == a || p == b || p == c) continue;
            if (contains(a, b, c, p)) return false;
        }
        return true;
    }

    // Corners that are clipped or no longer turn inwards need not be looked at again.
    void drop_straightened() {
        std::size_t kept = 0;
        for (const std::uint32_t j : inward_)
            if (before_[j] != gone && turn(j) <= 0) inward_[kept++] = j;
        inward_.resize(kept);
    }

    void emit(std::uint32_t a, std::uint32_t b, std::uint32_t c) { triangles_.insert(triangles_.end(), {a, b, c}); }

    void fan(std::uint32_t first) {
        for (std::uint32_t i = after_[first]; after_[i] != first; i = after_[i]) emit(first, i, after_[i]);
    }

    std::vector<Vec2d> flat_;
    std::size_t left_;
    std::vector<std::uint32_t> before_, after_, inward_;
    std::vector<std::uint32_t>& triangles_;
};

}  // namespace

bool triangulate(std::span<const Vec3f> polygon, std::vector<std::uint32_t>& triangles) {
    assert(polygon.size() >= 3);
    const auto fan = [&] {
        for (std::uint32_t i = 2; i < polygon.size(); ++i) triangles.insert(triangles.end(), {0, i - 1, i});
    };
    if (polygon.size() == 3) {
        fan();
        return true;
    }
    EarClipper clipper(polygon, triangles);
    // An outline may also turn left everywhere and go round twice; then ears overlap, and a fan is as good as any cut.
    if (clipper.convex()) {
        fan();
        return true;
    }
    return clipper.clip();
}

}  // namespace relievo
