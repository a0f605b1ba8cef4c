#include "reference/area_light.h"

#include "reference/cell_walk.h"

#include <numbers>

namespace relievo {

double reference_horizon(const HeightField& field, const ReferenceHit& point, Vec2d toward, double least, double enough,
                         double farthest) {
    assert(!field.empty() && point.found && least > 0);
    const Vec2d size{static_cast<double>(field.width()), static_cast<double>(field.height())};
    // t is the distance in UV. The walk asks for the field itself: a line of height `point.height` that does not climb.
    CellWalk walk(field, point.uv * size - Vec2d{0.5, 0.5}, toward * size, point.cell);
    double steepest = least;
    // Nearer than this the point counts as the cell's own entry: its height is known to 1e-12 or so, and is to be divided by the way.
    constexpr double here = 1e-9;
    for (;; walk.advance()) {
        const double entered = walk.entered();
        // Nothing is higher than 1, so from here on nothing rises steeper.
        if (entered > here && (1 - point.height) <= steepest * entered) break;
        if (entered >= farthest) break;
        const double leave = std::min(walk.leaves(), farthest);
        if (entered <= here || walk.highest_corner() - point.height > steepest * entered) {
            CellGap g = walk.gap(point.height, 0);
            if (entered <= here) {
                // Rise over run of a profile that starts in the point itself: slope + bend t, extreme at the ends.
                steepest = std::max({steepest, g.slope, g.slope + g.bend * leave});
            } else {
                // (gap + slope s + bend s^2) / (entered + s). In powers of t = entered + s the rise is a + b t + bend t^2; divided
                // by t it has an inner extreme where a = bend t^2, a maximum where both are negative.
                const double a = g.gap - g.slope * entered + g.bend * entered * entered;
                const double limit = leave - entered;
                steepest = std::max({steepest, g.gap / entered, g.at(limit) / leave});
                if (g.bend < 0 && a < 0) {
                    const double t = std::sqrt(a / g.bend);
                    if (t > entered && t < leave) steepest = std::max(steepest, g.at(t - entered) / t);
                }
            }
            if (steepest >= enough) break;
        }
    }
    return steepest;
}

double reference_light_share(const HeightField& field, const ReferenceHit& point, Vec3d to_light, double height_scale,
                             double radius_rad, int slices, double chart) {
    assert(radius_rad > 0 && slices > 0);
    const double elevation = std::asin(std::clamp(to_light.z, -1.0, 1.0));
    const double flat_length = std::hypot(to_light.x, to_light.y);
    assert(elevation + radius_rad < std::numbers::pi / 2 && flat_length > 0);
    const double azimuth = std::atan2(to_light.y, to_light.x);
    double seen = 0;
    double whole = 0;
    for (int k = 0; k < slices; ++k) {
        const double x = (2 * (k + 0.5)) / slices - 1;
        const double half = radius_rad * std::sqrt(1 - x * x);  // of the slice, in elevation
        const double a = azimuth + radius_rad * x / flat_length;
        const double low = std::max(elevation - half, 0.0);
        const double high = elevation + half;
        whole += 2 * half;
        if (high <= 0) continue;
        // A horizon below the slice's foot hides none of it; a whole period of a field 1 high and this foot would be walked for
        // nothing, so the foot is never quite 0.
        const double least = std::max(std::tan(low) / height_scale, 1e-3);
        const Vec2d toward{std::cos(a), std::sin(a)};
        const auto to_border = [&](double at, double by) { return by > 0 ? (chart - at) / by : by < 0 ? -at / by : 1e9; };
        const double farthest = chart > 0 ? std::max(0.0, std::min(to_border(point.uv.x, toward.x), to_border(point.uv.y, toward.y)))
                                          : std::numeric_limits<double>::infinity();
        const double slope = reference_horizon(field, point, toward, least, std::tan(high) / height_scale, farthest);
        const double horizon = std::atan(slope * height_scale);
        seen += std::clamp(high - std::max(horizon, low), 0.0, 2 * half);
    }
    return seen / whole;
}

}  // namespace relievo
