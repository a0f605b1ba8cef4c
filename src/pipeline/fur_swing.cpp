#include "pipeline/fur_swing.h"

#include "pipeline/fur_path.h"

#include <algorithm>
#include <numbers>

namespace relievo {

namespace {

constexpr int steps_per_frame = 10;    // of 1/250 s at 25 frames a second: every coat's swing takes 20 of them or more
constexpr double start_seconds = 0.5;  // in which the turning sets in

}  // namespace

FurSwing::FurSwing(const FurSkin& skin, const SwingSettings& settings) : skin_(skin), settings_(settings), motion_(settled(skin, {.gravity = settings.forces.gravity}, settings.threads)) {}

void FurSwing::next_frame() {
    const double full_spin = settings_.turns_per_second * 2 * std::numbers::pi, h = 1 / (settings_.frames_per_second * steps_per_frame);
    for (int step = 0; step < steps_per_frame; ++step) {
        const double start = std::min(time_ / start_seconds, 1.0), spin = full_spin * start;
        FurForces f = settings_.forces;
        f.gravity = turned(settings_.forces.gravity, -angle_);
        f.wind = turned(settings_.forces.wind, -angle_);
        f.time = time_ + h / 2;
        f.spin = {0, spin, 0};
        f.spin_change = {0, start < 1 ? full_spin / start_seconds : 0, 0};
        motion_ = after(motion_, skin_, f, h, settings_.threads);
        angle_ += spin * h;
        time_ += h;
    }
}

}  // namespace relievo
