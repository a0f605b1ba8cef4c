// Where points of fur space land in the picture, and how pictures that are averaged are moved against each other.
#pragma once

#include "render/mesh_renderer.h"

#include <array>
#include <cmath>

namespace relievo {

// Rows of (x, y, z, offset) as a matrix, columns first.
inline std::array<float, 16> matrix(const std::array<std::array<double, 4>, 4>& rows) {
    std::array<float, 16> m;
    for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 4; ++c) m[c * 4 + r] = static_cast<float>(rows[r][c]);
    return m;
}

// To clip space: y down the screen, depth from 0 at the near plane to 1 at the far one. `shift` moves the picture, in pixels.
inline std::array<float, 16> eye_matrix(const MeshView& view, Vec2d shift) {
    const Camera::Axes axes = view.camera.axes();
    const double up = 1 / std::tan(view.camera.fov_y_rad / 2), across = up * view.height / view.width;
    const double depth = view.far / (view.far - view.near);
    const Vec3d w = axes.back * -1.0;
    const Vec3d x = axes.right * across + w * (2 * shift.x / view.width), y = axes.up * -up + w * (2 * shift.y / view.height), z = w * depth;
    const Vec3d& e = view.camera.eye;
    return matrix({{{x.x, x.y, x.z, -dot(x, e)}, {y.x, y.y, y.z, -dot(y, e)}, {z.x, z.y, z.z, -dot(z, e) - depth * view.near}, {w.x, w.y, w.z, -dot(w, e)}}});
}

// The i-th point of a sequence that fills the unit square evenly from its beginning (Roberts 2018, "The Unreasonable Effectiveness of
// Quasirandom Sequences").
inline Vec2d quasirandom(int i) {
    const double x = 0.5 + i * 0.7548776662466927, y = 0.5 + i * 0.5698402909980532;
    return {x - std::floor(x), y - std::floor(y)};
}

}  // namespace relievo
