#include "fur/strand_albedo.h"

#include <algorithm>
#include <cmath>

namespace relievo {

namespace {

Vec3d mixed(Vec3d a, Vec3d b, double t) { return a * (1 - t) + b * t; }
double fraction(double x) { return x - std::floor(x); }

}  // namespace

Vec3d strand_albedo(const Coat& coat, const StrandCurves::Strand& strand, double way) {
    const double u = (strand.chance & 255u) / 255.0, v = (strand.chance >> 8) / 255.0;
    Vec3d albedo = mixed(Vec3d(coat.root_colour), Vec3d(coat.tip_colour), std::sqrt(way)) * (1 + coat.colour_variation * (2 * fraction(u * 5.3 + v * 3.1) - 1));
    if (fraction(v * 13.7 + u) < static_cast<double>(coat.grizzle)) albedo = mixed(albedo, Vec3d(0.75), 0.7);
    const double below = std::clamp(-static_cast<double>(strand.normal.y), 0.0, 1.0);
    return mixed(albedo, {std::sqrt(albedo.x), std::sqrt(albedo.y), std::sqrt(albedo.z)}, coat.countershade * below) * (1 + 0.25 * static_cast<double>(strand.sway));
}

}  // namespace relievo
