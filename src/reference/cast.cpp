#include "reference/cast.h"

#include "reference/cell_walk.h"

namespace relievo {

namespace {

constexpr double none = -1;

// First s in [0, limit] at which the gap closes, or none. In the stable form, which never subtracts nearly equal terms (Press et
// al., Numerical Recipes, 5.6); a gap below 0 at the entry leaves one candidate of the two roots.
double first_contact(const CellGap& g, double limit) {
    if (g.gap >= 0) return 0;
    const double discriminant = g.slope * g.slope - 4 * g.bend * g.gap;
    if (!(discriminant >= 0)) return none;
    const double q = -0.5 * (g.slope + std::copysign(std::sqrt(discriminant), g.slope));
    // Closing from the start (q < 0): the nearer root. Opening at first (q > 0): closes only where the profile bends upward.
    // Neither: the gap never changes.
    double s = none;
    if (q < 0) s = g.gap / q;
    else if (q > 0 && g.bend > 0) s = q / g.bend;
    return s >= 0 && s <= limit ? s : none;
}

}  // namespace

ReferenceHit reference_cast(const HeightField& field, const ReferenceRay& ray) {
    assert(!field.empty() && ray.z_start >= ray.z_end);
    const Vec2d size{static_cast<double>(field.width()), static_cast<double>(field.height())};
    const Vec2d start = (ray.uv + (ray.z_start - ray.zero_level) * ray.uv_per_height) * size - Vec2d{0.5, 0.5};
    assert(std::abs(start.x) < 2e9 && std::abs(start.y) < 2e9);
    const double end = ray.z_start - ray.z_end;

    // t is the descent since z_start.
    CellWalk walk(field, start, -(ray.uv_per_height * size));
    ReferenceHit hit;
    for (;; walk.advance()) {
        const double leave = std::min(walk.leaves(), end);
        if (!(ray.z_start - leave > walk.highest_corner())) {
            const double s = first_contact(walk.gap(ray.z_start - walk.entered(), -1), leave - walk.entered());
            if (s != none) {
                hit = {.found = true, .uv = {}, .height = ray.z_start - (walk.entered() + s), .cell = walk.cell()};
                break;
            }
        }
        if (walk.leaves() >= end) {
            // Nothing is lower than the floor: what rounding kept from closing there closes.
            if (ray.z_end <= 0) hit = {.found = true, .uv = {}, .height = ray.z_end, .cell = walk.cell()};
            break;
        }
    }
    hit.uv = ray.uv + ((hit.found ? hit.height : ray.z_end) - ray.zero_level) * ray.uv_per_height;
    return hit;
}

bool reference_shadow(const HeightField& field, const ReferenceHit& point, Vec3d to_light, double height_scale,
                      double highest) {
    assert(!field.empty() && point.found && highest <= 1);
    if (!(to_light.z > 0)) return true;
    const Vec2d size{static_cast<double>(field.width()), static_cast<double>(field.height())};
    const Vec2d speed = Vec2d{to_light.x, to_light.y} * (height_scale / std::max(to_light.z, flattest_cosine)) * size;
    const double end = std::max(0.0, highest - point.height);

    // t is the climb since the point. The gap is 0 there by definition, not by evaluation, and passes from cell to cell unbroken
    // because the surface does: the known root is factored out instead of stepped over, so a point on a wall or on a crease is
    // judged like any other and no bias is needed.
    CellWalk walk(field, point.uv * size - Vec2d{0.5, 0.5}, speed, point.cell);
    double carried = 0;
    bool carry = true;
    for (;; walk.advance()) {
        const double leave = std::min(walk.leaves(), end);
        const double z = point.height + walk.entered();
        if (z > walk.highest_corner()) {
            carry = false;
        } else {
            CellGap g = walk.gap(z, 1);
            if (carry) g.gap = carried;
            const double limit = leave - walk.entered();
            const double vertex = -g.slope / (2 * g.bend);  // NaN or infinite where the profile is straight
            carried = g.at(limit);
            carry = true;
            if (carried > 0) return true;
            if (g.bend < 0 && vertex > 0 && vertex < limit && g.at(vertex) > 0) return true;
        }
        if (walk.leaves() >= end) return false;
    }
}

}  // namespace relievo
