// Box and smallest sphere around a mesh, and moving it to the origin.
#pragma once

#include "core/mesh.h"

#include <span>

namespace relievo {

struct Box {
    Vec3f low, high;
    Vec3d centre() const { return (Vec3d(low) + Vec3d(high)) * 0.5; }
    Vec3d size() const { return Vec3d(high) - Vec3d(low); }
};

struct Sphere {
    Vec3d centre;
    double radius = 0;
};

// The corners of the smallest axis-parallel box. Of no points: a box of size 0 at the origin.
Box bounding_box(std::span<const Vec3f> points, int threads = 0);

// The smallest sphere that contains all points (not the sphere around the box, whose radius, half the diagonal, is up to sqrt(3)
// times as large). Exact but for rounding: the radius is within 1e-9 of the smallest, and no point lies outside.
Sphere bounding_sphere(std::span<const Vec3f> points, int threads = 0);

// The mesh moved so that the centre of its box is the origin.
Mesh centred(Mesh mesh, int threads = 0);

}  // namespace relievo
