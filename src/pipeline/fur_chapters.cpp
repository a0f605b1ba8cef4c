#include "pipeline/fur_chapters.h"

#include "assets/atomic_file.h"
#include "assets/image_file.h"
#include "mesh/made_up_scan.h"
#include "pipeline/coat_painter.h"
#include "pipeline/fur_effects.h"
#include "pipeline/fur_reference.h"
#include "pipeline/fur_score.h"
#include "pipeline/grown_fur.h"

#include <cctype>
#include <cmath>
#include <cstdio>
#include <optional>
#include <sstream>

namespace relievo {

namespace {

constexpr int panel_width = 480, panel_height = 300;  // 8 by 5, as budgets are meant
constexpr int passes = 16, samples = 16;
constexpr std::uint32_t scan_faces = 16000;

std::string shown(double value, const FurMeasure& m) {
    if (!std::isfinite(value)) return "-";
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", 3, value * m.times);
    return text;
}

// What every figure shows: the first coat on a made-up scan, and its strands traced.
struct Truth {
    Mesh mesh;
    Coat coat;
    FurView view;
    FurFrames traced;
};

Truth traced_truth(int threads) {
    Truth t{.mesh = made_up_scan({.faces = scan_faces, .threads = threads}), .coat = coat_presets().front().coat, .view = {}, .traced = {}};
    t.view = {.camera = view_of_sphere({0, 0, 0}, 1 + static_cast<double>(t.coat.length) * 0.6, panel_width, panel_height), .passes = passes};
    GrownFur grown = grown_fur(t.mesh, t.coat, {}, threads);
    t.traced = trace_fur(curves_of(grown, t.coat, reference_pieces, {}, threads), grown.mesh, t.coat, t.view, samples, threads);
    return t;
}

FurErrors drawn_figure(const FurMode& mode, const Truth& truth, const FurChaptersSettings& s) {
    CoatPainter painter(mode.kind, s.device);
    FurView view = truth.view;
    view = with_layers(view, painter.wear(truth.mesh, truth.coat, view.camera, 0, s.threads).layers);
    painter.fit_light(view, truth.traced);
    const FurFrames frames = painter.draw(view);
    write_png(s.out / "figures" / ("fur-mode-" + std::string(mode.id) + ".png"), side_by_side(shown_fur(frames), shown_fur(truth.traced)), FirstRow::top);
    const FurScore score = fur_score(frames, truth.traced, s.threads);
    return {.flip = score.flip, .coverage_error = score.coverage_error, .gaps = score.gaps, .density_p95_over_p5 = painter.counted(s.threads).evenness.density_p95_over_p5};
}

std::string chapter(const FurMode& mode, const std::optional<FurErrors>& measured, const FurEffectRow* effects) {
    std::ostringstream out;
    const std::string id(mode.id), chapter(mode.chapter);
    out << "# " << mode.title << "\n\n*" << mode.author << ", \"" << mode.source << "\", " << mode.year << ".*\n\n"
        << "Mode `" << id << "` of `relievo fur`: " << mode.summary << ". [How it works](../../" << chapter << ").\n\n"
        << "![" << mode.title << " and traced strands](../figures/fur-mode-" << id << ".png)\n\n"
        << "*A made-up scan of " << scan_faces << " faces in the coat `" << coat_presets().front().id << "`. Left: " << id << ", " << passes
        << " passes" << (light_is_fitted(mode.kind) ? ", in the light that brings it nearest to the right by least squares, which is flat where strands do not lie as they should" : "")
        << ". Right: the coat's strands as curves, ray traced. Made by `relievo docs`; the same on a file: `relievo compare fur MESH --mode " << id << " --out report`.*\n\n"
        << "## What it shows\n\n| effect | claimed |\n|---|---|\n";
    for (const FurEffectKind& k : fur_effect_kinds()) out << "| " << k.title << " | " << (mode.effects.*k.claim ? "yes" : "no") << " |\n";
    out << "\n<!-- measured -->\n";
    if (effects != nullptr) {
        out << "Measured, as shares: ";
        for (std::size_t k = 0; k < fur_effect_count; ++k) {
            char share[16];
            std::snprintf(share, sizeof share, "%.2f", std::max(effects->shares[k], 0.0));
            out << (k > 0 ? ", " : "") << fur_effect_kinds()[k].title << ' ' << share;
        }
        out << ".\n";
    }
    out << "<!-- /measured -->\n\n[What each is and where the line is drawn](../effects.md#fur)\n\n"
        << "## How right it is\n\nOn any mesh and in any coat its pictures are off by no more than this ([how that was set](../../concepts/promises.md#fur); the contract and every `compare fur` "
           "check it):\n\n| measure | at most | |\n|---|---|---|\n";
    for (const FurMeasure& m : fur_measures) out << "| " << m.title << " | " << shown(mode.budget.*m.value, m) << " | " << m.help << " |\n";
    out << "\n<!-- measured -->\n";
    if (measured) {
        out << "In the figure: ";
        for (const FurMeasure& m : fur_measures) out << (&m == fur_measures ? "" : ", ") << m.title << ' ' << shown(*measured.*m.value, m);
        out << ".\n";
    }
    out << "<!-- /measured -->\n\n## Where it fails\n\n" << static_cast<char>(std::toupper(mode.limits[0])) << mode.limits.substr(1) << ".\n";
    return out.str();
}

}  // namespace

std::string write_fur_chapters(const FurChaptersSettings& s, const Progress& progress) {
    std::vector<FurEffectRow> effects;
    std::optional<Truth> truth;
    if (s.drawn) {
        effects = fur_effects_table(s.device, progress);
        truth = traced_truth(s.threads);
    }
    for (std::size_t i = 0; i < std::size(fur_modes); ++i) {
        const FurMode& mode = fur_modes[i];
        std::optional<FurErrors> measured;
        if (truth) measured = drawn_figure(mode, *truth, s);
        write_file_atomically(s.out / "fur" / (std::string(mode.id) + ".md"), chapter(mode, measured, s.drawn ? &effects[i] : nullptr));
    }
    std::ostringstream out;
    out << "\n## Fur\n\nWhat draws fur is asked for other effects, each again in a scene in which it can only be there or not ([`fur_effects.cpp`](../../src/pipeline/fur_effects.cpp); "
           "`relievo effects --fur`).\n\n| effect | scene | number | there from | absent up to |\n|---|---|---|---|---|\n";
    for (const FurEffectKind& k : fur_effect_kinds()) {
        char limits[48];
        std::snprintf(limits, sizeof limits, "%.2g | %.2g", k.present_from, k.absent_to);
        out << "| " << k.title << " | " << k.scene << " | " << k.number << " | " << limits << " |\n";
    }
    out << "\n<!-- measured -->\n" << (s.drawn ? fur_effects_text(effects, true) : std::string()) << "<!-- /measured -->\n";
    return out.str();
}

}  // namespace relievo
