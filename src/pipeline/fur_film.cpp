#include "pipeline/fur_film.h"

#include "pipeline/fur_score.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relievo {

namespace {

constexpr int steps_per_frame = 10;    // of 1/250 s at 25 frames a second: every coat's swing takes 20 of them or more
constexpr double start_seconds = 0.5;  // in which the turning sets in

Vec3d turned(Vec3d p, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * p.x + s * p.z, p.y, c * p.z - s * p.x};
}

}  // namespace

void film_fur(FurPainter& painter, const FurView& view, const FurForces& forces, const FurFilm& film, int threads) {
    const FurSkin skin = painter.skin();
    const double full_spin = film.turns_per_second * 2 * std::numbers::pi, h = 1 / (film.frames_per_second * steps_per_frame);
    FurMotion motion = settled(skin, {.gravity = forces.gravity}, threads);
    double angle = 0, time = 0;
    for (int frame = 0; frame < film.frames; ++frame) {
        painter.push(pushes_of(motion));
        // The mesh stays where it is: camera and lights go round it the other way.
        FurView seen = view;
        seen.camera.camera.eye = turned(view.camera.camera.eye, -angle);
        seen.camera.camera.target = turned(view.camera.camera.target, -angle);
        seen.to_key = turned(view.to_key, -angle);
        seen.to_rim = turned(view.to_rim, -angle);
        film.shown(frame, shown_fur(painter.draw(seen)));
        for (int step = 0; step < steps_per_frame; ++step) {
            const double start = std::min(time / start_seconds, 1.0), spin = full_spin * start;
            FurForces f = forces;
            f.gravity = turned(forces.gravity, -angle);
            f.wind = turned(forces.wind, -angle);
            f.time = time + h / 2;
            f.spin = {0, spin, 0};
            f.spin_change = {0, start < 1 ? full_spin / start_seconds : 0, 0};
            motion = after(motion, skin, f, h, threads);
            angle += spin * h;
            time += h;
        }
    }
}

}  // namespace relievo
