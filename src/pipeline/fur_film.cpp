#include "pipeline/fur_film.h"

#include "pipeline/fur_path.h"
#include "pipeline/fur_reference.h"
#include "pipeline/fur_score.h"
#include "pipeline/fur_swing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace relievo {

namespace {

double distance_of(const FurFilm& film, int frame) {
    if (film.frames < 2) return film.dolly.first;
    return film.dolly.first * std::pow(film.dolly.last / film.dolly.first, static_cast<double>(frame) / (film.frames - 1));
}

// The strands' curves in each frame: those of the forces' balance, or of a swing of their own that takes the steps of the painter's.
class Truth {
public:
    Truth(const FilmedFur& filmed, const FurFilm& film, const SwingSettings& swing, int threads) : filmed_(filmed), threads_(threads) {
        if (film.swings) {
            comb_ = comb_of(filmed.fur, filmed.coat, threads);
            swing_.emplace(FurSkin{filmed.fur.mesh, comb_, filmed.fur.lengths, filmed.coat}, swing);
        } else {
            curves_ = curves_of(filmed.fur, filmed.coat, reference_pieces, filmed.forces, threads);
        }
    }

    FurFrames traced(const FurView& view, int samples) {
        if (swing_) curves_ = strand_curves(filmed_.fur.mesh, comb_, filmed_.fur.roots, filmed_.coat, filmed_.fur.spacing, reference_pieces, threads_, {.lengths = filmed_.fur.lengths, .pushes = swing_->pushes()});
        return trace_fur(curves_, filmed_.fur.mesh, filmed_.coat, view, samples, threads_, {}, filmed_.fur.lengths);
    }
    void next_frame() {
        if (swing_) swing_->next_frame();
    }

private:
    const FilmedFur& filmed_;
    int threads_;
    std::vector<Vec3f> comb_;
    std::optional<FurSwing> swing_;
    StrandCurves curves_;
};

}  // namespace

FurView nearest_view(const FurView& view, const FurFilm& film, FurKind kind, const Coat& coat, bool layers_adapt) {
    if (film.frames == 0) return view;
    const double nearest = std::min({film.dolly.first, film.dolly.last, 1.0}), farthest = std::max({film.dolly.first, film.dolly.last, 1.0});
    FurView seen = from_afar(view, nearest);
    if (layers_adapt && farthest > 1) seen = with_layers(seen, std::min(layers_of(view), layers_for(kind, from_afar(view, farthest).camera, coat)));
    return seen;
}

std::optional<FurSteadiness> film_fur(const FilmedFur& filmed, const FurFilm& film, int threads, const Progress& progress) {
    const std::vector<int> passes = film.passes.empty() ? std::vector<int>{filmed.view.passes} : film.passes;
    const bool compares = film.samples > 0;
    const SwingSettings settings{.forces = filmed.forces, .turns_per_second = film.turns_per_second, .frames_per_second = film.frames_per_second, .threads = threads};
    std::optional<FurSwing> swing;
    if (film.swings) swing.emplace(filmed.painter.skin(), settings);
    std::optional<Truth> truth;
    if (compares) truth.emplace(filmed, film, settings, threads);
    SteadinessMeter meter(passes, film.samples);
    double layers_before = 0;
    for (int frame = 0; frame < film.frames; ++frame) {
        report(progress, "filming, frame " + std::to_string(frame + 1) + " of " + std::to_string(film.frames), static_cast<double>(frame) / film.frames);
        if (swing && frame > 0) swing->next_frame();
        if (truth && frame > 0) truth->next_frame();
        if (!compares && film.wanted && !film.wanted(frame)) continue;
        if (swing) filmed.painter.push(swing->pushes());
        const double distance = distance_of(film, frame);
        FurView seen = turned(from_afar(filmed.view, distance), film.degrees * std::numbers::pi / 180 * frame / film.frames + (swing ? swing->angle() : 0.0));
        if (filmed.layers_adapt && distance != 1) seen = with_layers(seen, layers_for(filmed.painter.kind(), seen.camera, filmed.coat));
        FilmedFrame now{.distance = distance, .layers = layers_of(seen), .pictures = {}, .reference = {}, .as_layered_before = {}};
        for (std::size_t i = compares ? 0 : passes.size() - 1; i < passes.size(); ++i) {
            seen.passes = passes[i];
            now.pictures.push_back(filmed.painter.draw(seen));
        }
        if (film.shown) film.shown(frame, shown_fur(now.pictures.back()));
        if (!compares) continue;
        now.reference = truth->traced(seen, film.samples);
        if (frame > 0 && layers_before != layers_of(seen))
            for (const int count : passes) {
                FurView former = with_layers(seen, layers_before);
                former.passes = count;
                now.as_layered_before.push_back(filmed.painter.draw(former));
            }
        layers_before = layers_of(seen);
        meter.add(std::move(now));
    }
    return meter.result();
}

}  // namespace relievo
