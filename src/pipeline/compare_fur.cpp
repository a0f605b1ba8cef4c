#include "pipeline/compare_fur.h"

#include "assets/atomic_file.h"
#include "assets/mesh_file.h"
#include "core/error.h"
#include "core/version.h"
#include "pipeline/classic_picture.h"
#include "pipeline/fur_picture.h"
#include "pipeline/fur_reference.h"
#include "pipeline/grown_fur.h"
#include "pipeline/lapped_picture.h"

namespace relievo {

namespace {

struct Truth {
    FurFrames frames;
    std::string picture;
};

FurPicture grown_as(FurKind mode, const std::filesystem::path& file, const Coat& coat, const CompareFurSettings& s) {
    if (mode == FurKind::classic) {
        // What a map and the normal can say of a coat: its length and its colours.
        ClassicSettings classic;
        classic.height = coat.length;
        classic.colour = coat.tip_colour;
        classic.skin = coat.root_colour;
        classic.gloss = coat.gloss;
        if (s.layers > 0) classic.layers = s.layers;
        classic.width_px = s.width;
        classic.height_px = s.height;
        classic.passes = s.passes;
        classic.device = s.device;
        classic.measure = true;
        classic.fit_light = true;
        classic.reference_samples = s.samples;
        classic.threads = s.threads;
        return classic_picture(file, classic);
    }
    if (mode == FurKind::lapped) {
        LappedFurSettings lapped;
        lapped.coat = coat;
        if (s.layers > 0) lapped.layers = s.layers;
        lapped.width = s.width;
        lapped.height = s.height;
        lapped.passes = s.passes;
        lapped.device = s.device;
        lapped.measure = true;
        lapped.fit_light = true;
        lapped.reference_samples = s.samples;
        lapped.threads = s.threads;
        return lapped_picture(file, lapped);
    }
    FurSettings strands;
    strands.mode = mode;
    strands.coat = coat;
    strands.layers = s.layers;
    strands.width = s.width;
    strands.height = s.height;
    strands.passes = s.passes;
    strands.device = s.device;
    strands.measure = true;
    strands.threads = s.threads;
    return fur_picture(file, strands);
}

FurRow row_of(const FurPicture& p, const FurScore& score, const FurMode& mode) {
    return {.mesh = {}, .preset = {}, .mode = std::string(mode.id), .faces = p.faces, .strands = p.strands, .layers = p.layers, .density_p95_over_p5 = p.evenness->density_p95_over_p5,
            .shared_texel_area = p.evenness->shared_texel_area, .flip = score.flip, .coverage_error = score.coverage_error, .gaps = score.gaps,
            .first_frame_ms = p.ms.first_frame, .frame_ms = p.ms.frame_median, .picture = {}, .reference = {}};
}

const FurMode& mode_of(FurKind kind) {
    for (const FurMode& m : fur_modes)
        if (m.kind == kind) return m;
    return fur_modes[0];
}

}  // namespace

FurComparison compare_fur(const CompareFurSettings& s, const Progress& progress) {
    std::error_code fault;
    std::filesystem::create_directories(s.out, fault);
    if (fault) throw Error("write the comparison to", s.out.string(), fault.message());
    FurComparison all{.version = std::string(version), .command = s.command, .device = {}, .width = s.width, .height = s.height, .passes = s.passes, .samples = s.samples, .rows = {}, .refused = {}};
    const double steps = static_cast<double>(s.meshes.size() * s.presets.size() * (s.modes.size() + 1));
    double done = 0;
    for (std::size_t m = 0; m < s.meshes.size(); ++m) {
        const std::filesystem::path& file = s.meshes[m];
        // Files of one name may lie in several folders.
        const std::string stem = (s.meshes.size() > 1 ? std::to_string(m + 1) + "_" : std::string()) + file.stem().string();
        for (const CoatPreset& preset : s.presets) {
            const std::string start = stem + "_" + std::string(preset.id) + "_";
            Truth truth{.frames = {}, .picture = start + "traced.png"};
            try {
                report(progress, "tracing " + start.substr(0, start.size() - 1), done / steps);
                GrownFur grown = grown_fur(load_mesh(file, s.threads), preset.coat, {}, s.threads);
                const FurView view{.camera = view_of_sphere({0, 0, 0}, 1 + static_cast<double>(preset.coat.length) * 0.6, s.width, s.height)};
                truth.frames = trace_fur(curves_of(grown, preset.coat, reference_pieces, {}, s.threads), grown.mesh, preset.coat, view, s.samples, s.threads);
            } catch (const Error& e) {
                all.refused.emplace_back(e.what());
                done += static_cast<double>(s.modes.size() + 1);
                break;
            }
            write_fur_picture(s.out / truth.picture, shown_fur(truth.frames));
            ++done;
            for (const FurKind kind : s.modes) {
                const FurMode& mode = mode_of(kind);
                report(progress, "drawing " + start + std::string(mode.id), done / steps);
                const FurPicture p = grown_as(kind, file, preset.coat, s);
                FurRow row = row_of(p, fur_score(p.frames, truth.frames, s.threads), mode);
                row.mesh = file.filename().string();
                row.preset = preset.id;
                row.picture = start + std::string(mode.id) + ".png";
                row.reference = truth.picture;
                write_fur_picture(s.out / row.picture, p.picture);
                all.device = p.device;
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
