#include "pipeline/fur_turntable.h"

#include "pipeline/fur_reference.h"
#include "pipeline/fur_score.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace relievo {

namespace {

Vec3d turned(Vec3d p, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * p.x + s * p.z, p.y, c * p.z - s * p.x};
}

struct Compared {
    FurFrames picture, reference;
};

struct Change {
    double picture = 0, reference = 0, error = 0;
};
Change change_between(const Compared& a, const Compared& b) {
    Change sum;
    std::size_t covered = 0;
    for (std::size_t p = 0; p < a.picture.coverage.texels.size(); ++p) {
        if (!(a.picture.coverage.texels[p] > 0 || b.picture.coverage.texels[p] > 0 || a.reference.coverage.texels[p] > 0 || b.reference.coverage.texels[p] > 0)) continue;
        ++covered;
        for (std::size_t c = p * 3; c < p * 3 + 3; ++c) {
            const double picture = static_cast<double>(b.picture.colour.texels[c]) - static_cast<double>(a.picture.colour.texels[c]);
            const double reference = static_cast<double>(b.reference.colour.texels[c]) - static_cast<double>(a.reference.colour.texels[c]);
            sum.picture += std::abs(picture);
            sum.reference += std::abs(reference);
            sum.error += std::abs(picture - reference);
        }
    }
    const double weight = covered > 0 ? 1 / (3 * static_cast<double>(covered)) : 0;
    return {sum.picture * weight, sum.reference * weight, sum.error * weight};
}

}  // namespace

std::optional<FurSteadiness> turn_fur(FurPainter& painter, const GrownFur& fur, const Coat& coat, const FurView& view, const FurTurntable& turntable, const StrandCurves* curves, int samples,
                                      int threads, const Progress& progress) {
    std::vector<Change> changes;
    std::optional<Compared> before;
    for (int frame = 0; frame < turntable.frames; ++frame) {
        report(progress, "turning, frame " + std::to_string(frame + 1) + " of " + std::to_string(turntable.frames), static_cast<double>(frame) / turntable.frames);
        if (!curves && turntable.wanted && !turntable.wanted(frame)) continue;
        // The mesh stays where it is: camera and lights go round it the other way.
        const double angle = -turntable.degrees * std::numbers::pi / 180 * frame / turntable.frames;
        FurView seen = view;
        seen.camera.camera.eye = turned(view.camera.camera.eye, angle);
        seen.camera.camera.target = turned(view.camera.camera.target, angle);
        seen.to_key = turned(view.to_key, angle);
        seen.to_rim = turned(view.to_rim, angle);
        Compared now{painter.draw(seen), {}};
        if (turntable.shown) turntable.shown(frame, shown_fur(now.picture));
        if (!curves) continue;
        now.reference = trace_fur(*curves, fur.mesh, coat, seen, samples, threads, {}, fur.lengths);
        if (before) changes.push_back(change_between(*before, now));
        before = std::move(now);
    }
    if (changes.empty()) return std::nullopt;
    FurSteadiness result;
    std::vector<double> errors;
    for (const Change& c : changes) {
        const double share = 1 / static_cast<double>(changes.size());
        result.change += share * c.picture;
        result.reference_change += share * c.reference;
        result.error_change += share * c.error;
        errors.push_back(c.error);
    }
    std::ranges::sort(errors);
    const double median = errors[errors.size() / 2];
    result.worst_over_median = median > 0 ? errors.back() / median : 1;
    return result;
}

}  // namespace relievo
