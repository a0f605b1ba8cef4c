// Where a film of fur is seen from. The mesh stays where it is: camera and lights go round it the other way.
#pragma once

#include "render/fur_frames.h"

#include <cmath>

namespace relievo {

// Counter-clockwise around the vertical axis, seen from above.
inline Vec3d turned(Vec3d p, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * p.x + s * p.z, p.y, c * p.z - s * p.x};
}

// As `view` shows the mesh once it has turned by `angle`, under lights that stay with the camera.
inline FurView turned(FurView view, double angle) {
    view.camera.camera.eye = turned(view.camera.camera.eye, -angle);
    view.camera.camera.target = turned(view.camera.camera.target, -angle);
    view.to_key = turned(view.to_key, -angle);
    view.to_rim = turned(view.to_rim, -angle);
    return view;
}

// The camera `factor` times as far from what it looks at. Nearer than this it would be among the fur.
inline constexpr double nearest_dolly = 0.4;
inline FurView from_afar(FurView view, double factor) {
    const Vec3d way = view.camera.camera.eye - view.camera.camera.target;
    const double farther = length(way) * (factor - 1);
    view.camera.camera.eye = view.camera.camera.target + way * factor;
    view.camera.near += farther;
    view.camera.far += farther;
    return view;
}

}  // namespace relievo
