#include "pipeline/compare_fur.h"

#include "assets/atomic_file.h"
#include "assets/mesh_file.h"
#include "core/error.h"
#include "core/version.h"
#include "pipeline/coat_painter.h"
#include "pipeline/fur_picture.h"
#include "pipeline/fur_reference.h"
#include "pipeline/grown_fur.h"
#include "pipeline/timer.h"

#include <algorithm>
#include <map>

namespace relievo {

namespace {

struct Truth {
    FurView view;
    FurFrames frames;
    std::string picture;
};

// One picture and all its numbers. `traced` is what the view should show.
FurRow scored(CoatPainter& painter, const FurMode& mode, const Mesh& mesh, const Coat& coat, FurView view, const FurFrames& traced, const CompareFurSettings& s, Image8& picture) {
    FurRow row;
    row.mode = mode.id;
    const Timer timer;
    const CoatPainter::Worn worn = painter.wear(mesh, coat, view.camera, s.layers, s.threads);
    view = with_layers(view, worn.layers);
    view.passes = 1;
    shown_fur(painter.draw(view));
    row.first_frame_ms = timer.ms();
    view.passes = s.passes;
    painter.fit_light(view, traced);
    FurFrames frames = painter.draw(view);
    std::ranges::sort(frames.frame_ms);
    const FurScore score = fur_score(frames, traced, s.threads);
    const CoatPainter::Counted counted = painter.counted(s.threads);
    row.faces = worn.faces;
    row.strands = counted.strands;
    row.layers = view.layers;
    row.shared_texel_area = counted.evenness.shared_texel_area;
    row.errors = {.flip = score.flip, .coverage_error = score.coverage_error, .gaps = score.gaps, .density_p95_over_p5 = counted.evenness.density_p95_over_p5};
    row.budget = mode.budget;
    row.frame_ms = frames.frame_ms[frames.frame_ms.size() / 2];
    picture = shown_fur(frames);
    return row;
}

}  // namespace

FurComparison compare_fur(const CompareFurSettings& s, const Progress& progress) {
    const Growth growth = with_pictures({.lengths = {}, .comb = s.comb});
    std::error_code fault;
    std::filesystem::create_directories(s.out, fault);
    if (fault) throw Error("write the comparison to", s.out.string(), fault.message());
    FurComparison all{.version = std::string(version), .command = s.command, .device = {}, .width = s.width, .height = s.height, .passes = s.passes, .samples = s.samples, .rows = {}, .refused = {}};
    const double steps = static_cast<double>(s.meshes.size() * s.presets.size() * (s.modes.size() + 1));
    double done = 0;
    std::map<FurKind, std::unique_ptr<CoatPainter>> painters;
    for (std::size_t m = 0; m < s.meshes.size(); ++m) {
        const std::filesystem::path& file = s.meshes[m];
        // Files of one name may lie in several folders.
        const std::string stem = (s.meshes.size() > 1 ? std::to_string(m + 1) + "_" : std::string()) + file.stem().string();
        for (const CoatPreset& preset : s.presets) {
            const std::string start = stem + "_" + std::string(preset.id) + "_";
            Truth truth{.view = {.camera = view_of_sphere({0, 0, 0}, 1 + static_cast<double>(preset.coat.length) * 0.6, s.width, s.height)}, .frames = {}, .picture = start + "traced.png"};
            Mesh mesh;
            try {
                report(progress, "tracing " + start.substr(0, start.size() - 1), done / steps);
                mesh = load_mesh(file, s.threads);
                GrownFur grown = grown_fur(mesh, preset.coat, growth, s.threads);
                truth.frames = trace_fur(curves_of(grown, preset.coat, reference_pieces, {}, s.threads), grown.mesh, preset.coat, truth.view, s.samples, s.threads);
            } catch (const Error& e) {
                all.refused.emplace_back(e.what());
                done += static_cast<double>(s.modes.size() + 1);
                break;
            }
            write_fur_picture(s.out / truth.picture, shown_fur(truth.frames));
            ++done;
            for (const FurKind kind : s.modes) {
                const FurMode& mode = fur_mode(kind);
                report(progress, "drawing " + start + std::string(mode.id), done / steps);
                std::unique_ptr<CoatPainter>& painter = painters[kind];
                if (!painter) painter = std::make_unique<CoatPainter>(kind, s.device);
                painter->paint(growth.comb);
                Image8 picture;
                FurRow row = scored(*painter, mode, mesh, preset.coat, truth.view, truth.frames, s, picture);
                row.mesh = file.filename().string();
                row.preset = preset.id;
                row.picture = start + std::string(mode.id) + ".png";
                row.reference = truth.picture;
                write_fur_picture(s.out / row.picture, picture);
                all.device = painter->device_name();
                all.rows.push_back(std::move(row));
                ++done;
            }
        }
    }
    if (all.rows.empty()) throw Error("compare fur on", s.meshes.size() == 1 ? s.meshes[0].string() : "these " + std::to_string(s.meshes.size()) + " meshes", "nothing grows there: " + (all.refused.empty() ? std::string("no mode was named") : all.refused.front()));
    write_file_atomically(s.out / "results.json", fur_comparison_json(all));
    write_file_atomically(s.out / "results.csv", fur_comparison_csv(all));
    write_file_atomically(s.out / "index.html", fur_comparison_page(all));
    report(progress, "compared", 1);
    return all;
}

}  // namespace relievo
