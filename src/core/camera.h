// A perspective camera in world space (right-handed, z up, metres of no fixed size), and a point on it.
#pragma once

#include "core/vec.h"

#include <cmath>
#include <numbers>

namespace relievo {

struct Camera {
    Vec3d eye{0, -2, 1};
    Vec3d target{0, 0, 0};
    Vec3d up{0, 0, 1};
    double fov_y_rad = 0.6;
    // What an eye on the other side of the plane z = 0 sees, with the world mirrored in that plane: the eye stands above it as ever, and
    // the picture's up is the mirrored one.
    bool from_behind = false;

    // Orthonormal axes: right, up of the screen, and backward (from target to eye); left-handed from behind.
    struct Axes {
        Vec3d right, up, back;
    };
    Axes axes() const {
        const Vec3d back = normalize(eye - target);
        // Looking straight down the up vector leaves its direction undefined; north (y) is then the top of the screen.
        Vec3d right = cross(up, back);
        if (dot(right, right) < 1e-18) right = cross(Vec3d{0, 1, 0}, back);
        right = normalize(right);
        const Vec3d over = cross(back, right);
        return {right, from_behind ? -over : over, back};
    }

    // Unit direction of the ray through a point of the screen, in pixels from its top left corner (pixel centres at .5).
    Vec3d ray(Vec2d pixel, int width, int height) const {
        const Axes a = axes();
        const double tan_half = std::tan(fov_y_rad / 2);
        const double x = (2 * pixel.x / width - 1) * tan_half * width / height;
        const double y = (1 - 2 * pixel.y / height) * tan_half;
        return normalize(a.right * x + a.up * y - a.back);
    }
};

}  // namespace relievo
