// The exact share of a light with some size that reaches a point of the declared surface. No rays are counted: in a height field
// a point of the light is seen exactly when it stands above the horizon in its direction, so one walk answers for a whole slice
// of the light.
#pragma once

#include "reference/cast.h"

#include <limits>

namespace relievo {

// Steepest rise, in heights per unit of UV, of a line from a surface point to any point of the surface ahead, in direction `toward`
// (unit, UV space); the slope of the point's own patch counts. At least `least`: whatever stays below it is not looked for, which
// is what ends the walk; > 0. Stops early at or above `enough`, and at a distance of `farthest` in UV. The point must be found, and
// lie in its cell.
double reference_horizon(const HeightField& field, const ReferenceHit& point, Vec2d toward, double least, double enough,
                         double farthest = std::numeric_limits<double>::infinity());

// Share in [0,1] of a disc of light that stands above the point's horizon. The disc holds the directions at elevation e + radius y
// and azimuth a + radius x / cos e with x^2 + y^2 <= 1, where e and a are those of to_light (unit, tangent space); parts below
// the plane are hidden. It is cut into `slices` of equal width, each judged by the horizon along its middle and exact in between;
// with 16 the share is within 0.004 of that with 512 in the mean over rough fields (tests/reference/area_light.cpp).
// Beyond [0, chart]^2 nothing is in the way (chart 0: the field repeats). radius_rad > 0; the light may not stand so high that the disc holds the zenith.
double reference_light_share(const HeightField& field, const ReferenceHit& point, Vec3d to_light, double height_scale,
                             double radius_rad, int slices = 16, double chart = 0);

}  // namespace relievo
