#include "cli/commands.h"

#include "cli/classic_options.h"
#include "cli/growth_options.h"
#include "cli/progress_display.h"
#include "cli/steadiness_report.h"
#include "core/error.h"
#include "core/suggest.h"
#include "pipeline/fur_picture.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

namespace relievo {

namespace {

using Json = nlohmann::ordered_json;

const CoatPreset& preset_of(const std::string& id) {
    if (id.empty()) return coat_presets().front();
    std::vector<std::string> known;
    for (const CoatPreset& p : coat_presets()) {
        if (p.id == id) return p;
        known.emplace_back(p.id);
    }
    throw UsageError(unknown_word("preset", id, known));
}

void set_knob(Coat& coat, const std::string& setting) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) throw UsageError("--set takes NAME=VALUE, not \"" + setting + "\"");
    const std::string id = setting.substr(0, equals), text = setting.substr(equals + 1);
    std::vector<std::string> known;
    for (const CoatKnob& k : coat_knobs()) {
        known.emplace_back(k.id);
        if (k.id != id) continue;
        float value = 0;
        const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (fault != std::errc{} || end != text.data() + text.size() || !(value >= k.least && value <= k.most)) {
            char range[96];
            std::snprintf(range, sizeof range, "%g to %g", static_cast<double>(k.least), static_cast<double>(k.most));
            throw UsageError(id + " takes a number from " + range + ", not \"" + text + "\"");
        }
        coat.*k.member = value;
        return;
    }
    throw UsageError(unknown_word("setting", id, known));
}

std::vector<int> pass_counts(const std::string& text) {
    std::vector<int> counts;
    const char* at = text.data();
    const char* const last = at + text.size();
    while (true) {
        int count = 0;
        const auto [end, fault] = std::from_chars(at, last, count);
        if (fault != std::errc{} || count < 1 || count > 1024 || (end != last && *end != ',')) throw UsageError("--passes takes numbers from 1 to 1024, as in 1,2,4,8,16, not \"" + text + "\"");
        counts.push_back(count);
        if (end == last) return counts;
        at = end + 1;
    }
}

double rounded(double v) { return std::round(v * 1e4) / 1e4; }
// JSON has no infinity: where a twentieth of the surface is bare, the ratio is null.
Json number(double v) { return std::isfinite(v) ? Json(rounded(v)) : Json(); }

Json fur_json(const FurPicture& p, const std::string& preset, const std::string& out) {
    Json report = {{"device", p.device}, {"prepare_ms", rounded(p.ms.prepare)}, {"grid_ms", rounded(p.ms.grid)}, {"layer_faces", p.layer_faces}, {"bare", rounded(p.bare)}, {"passes", p.passes}, {"notes", p.notes}};
    if (p.score)
        report["reference"] = {{"flip", rounded(p.score->flip)},
                               {"coverage_error", rounded(p.score->coverage_error)},
                               {"gaps", rounded(p.score->gaps)},
                               {"samples", p.score->samples},
                               {"ms", rounded(p.score->reference_ms)}};
    for (std::size_t i = 0; i < p.stages.size(); ++i) {
        const FurStages& f = p.stages[i];
        report["stages_ms"][i == 0 ? "first" : "last"] = {{"light", rounded(f.light)}, {"skin", rounded(f.skin)}, {"grow", rounded(f.grow)}, {"plot", rounded(f.plot)}, {"shade", rounded(f.shade)}, {"copy", rounded(f.copy)}};
    }
    if (p.steadiness)
        report["steadiness"] = steadiness_json(*p.steadiness);
    if (p.light) report["light"] = classic_report(p);
    std::string_view mode;
    for (const FurMode& m : fur_modes)
        if (m.kind == p.mode) mode = m.id;
    return {{"mode", mode},
            {"preset", preset},
            {"faces", p.faces},
            {"strands", p.strands},
            {"density_p95_over_p5", p.evenness ? number(p.evenness->density_p95_over_p5) : Json()},
            {"shared_texel_area", p.evenness ? number(p.evenness->shared_texel_area) : Json()},
            {"layers", p.layers},
            {"ms",
             {{"load", rounded(p.ms.load)}, {"roots", rounded(p.ms.roots)}, {"first_frame", rounded(p.ms.first_frame)}, {"frame_median", rounded(p.ms.frame_median)}}},
            {"image", out.empty() ? Json() : Json(out)},
            {"report", report}};
}

std::string preset_list() {
    std::string text;
    for (const CoatPreset& p : coat_presets()) text += (text.empty() ? "" : "; ") + std::string(p.id) + ": " + std::string(p.summary);
    return text;
}

std::string mode_list() {
    std::string text;
    for (const FurMode& m : fur_modes) text += (text.empty() ? "" : "; ") + std::string(m.id) + ": " + std::string(m.summary);
    return text;
}

std::string knob_list() {
    std::string text = "Settings (--set NAME=VALUE):\n";
    for (const CoatKnob& k : coat_knobs()) {
        char line[256];
        std::snprintf(line, sizeof line, "  %-17s %g to %g: %s\n", std::string(k.id).c_str(), static_cast<double>(k.least), static_cast<double>(k.most), std::string(k.help).c_str());
        text += line;
    }
    return text;
}

}  // namespace

void add_fur_command(CLI::App& app) {
    struct Options {
        std::string in, out, reference, mode = "strands", preset, layers = "auto", passes = "16", device;
        std::vector<std::string> set;
        GrowthOptions growth;
        double height = 0, density = 0;
        ClassicOptions classic;
        std::vector<int> size{1280, 800};
        int samples = 16;
        FurSettings fur;
        bool json = false, quiet = false;
    };
    auto o = std::make_shared<Options>();
    auto* verb = app.add_subcommand("fur", "Grows fur on any mesh and draws it");
    verb->add_option("in", o->in, "mesh to read: OBJ, PLY, OFF, STL, glTF, GLB or our cache, each also as .gz")->required();
    std::vector<std::string> modes;
    for (const FurMode& m : fur_modes) modes.emplace_back(m.id);
    verb->add_option("--mode", o->mode, mode_list())->check(CLI::IsMember(modes))->capture_default_str();
    verb->add_option("--preset", o->preset, preset_list());
    verb->add_option("--layers", o->layers, "1 to 64, or auto: as many as the fur is long in the picture")->capture_default_str();
    verb->add_option("--height", o->height, "length of the longest strand, in percent of the radius of the mesh's smallest sphere")->check(CLI::Range(0.2, 50.0));
    verb->add_option("--density", o->density, "strands, in percent of the preset's (default 100); in mode classic, in percent of the fur map's texels (default 20)")->check(CLI::Range(0.1, 2000.0));
    verb->add_option("--set", o->set, "NAME=VALUE, a setting of the coat; may be repeated")->take_all();
    verb->add_option("--size", o->size, "of the picture, pixels across and down")->expected(2);
    verb->add_option("--passes", o->passes, "frames averaged into the picture, 1 to 1024, each with its samples elsewhere. Several, as 1,2,4,8,16: of the last, and --turntable or --animate with --reference tells how steady each is")->capture_default_str();
    add_classic_options(*verb, o->classic);
    verb->add_option("--device", o->device, "that draws: software, or part of a device's name (relievo list devices)");
    verb->add_option("--threads", o->fur.threads, "0: all cores")->check(CLI::Range(0, 1024))->capture_default_str();
    verb->add_option("--reference", o->reference, "FILE.png: beside the picture the same strands as curves, ray traced with shadows; --json then has the difference");
    verb->add_option("--samples", o->samples, "rays a pixel of the reference")->check(CLI::Range(1, 4096))->capture_default_str();
    add_growth_options(*verb, o->growth);
    verb->add_flag("--quiet", o->quiet, "no progress and no notes");
    verb->add_flag("--json", o->json, "print what was grown, how even it is and how long it took as JSON");
    verb->add_option("--out", o->out, "FILE.png");
    verb->footer("Examples:\n  relievo fur bunny.obj --out bunny.png\n"
                 "  relievo fur dragon.ply.gz --preset fox --out dragon.png --json\n"
                 "  relievo fur scan.stl --preset otter --height 4 --density 150 --set lock=0.4 --out wet.png\n"
                 "  relievo fur bunny.obj --size 640 400 --reference beside.png --samples 32 --json\n"
                 "  relievo fur bunny.obj --mode classic --layers 8 --height 2 --density 10 --out 2009.png\n"
                 "  relievo fur spot.obj --grow-where mask@bald.png --grow-where up=-0.6..0.2 --out spot.png\n"
                 "  relievo fur spot.obj --comb swirl.png --out combed.png\n"
                 "  relievo fur bunny.obj --preset fox --wind 2 0 0.5 --animate 50 --out windy.png\n"
                 "  relievo fur bunny.obj --size 240 150 --turntable 6 --turn 6 --passes 1,2,4,8,16 --samples 16 --reference beside.png\n"
                 "  relievo fur bunny.obj --size 240 150 --turntable 24 --dolly 1:3 --reference beside.png --json\n"
                 "  relievo fur bunny.obj --mode lapped --out lapped.png\n"
                 "  relievo fur bunny.obj --preset fox --density 20 --export fox.hair --export fox.ply\n"
                 "  relievo fur cow.obj --layers 32 --size 640 400 --passes 1 --out quick.png\n\n" +
                 knob_list() + length_rule_list() + classic_knob_list());
    verb->callback([o] {
        const bool drawn = !o->out.empty() || !o->reference.empty() || o->json || !o->classic.fur_map.empty() || !o->classic.tinted_map.empty();
        if (!drawn && o->growth.exported.empty()) throw UsageError("fur needs --out FILE.png for the picture, --export FILE for the strands, or --json to measure without either");
        FurSettings& s = o->fur;
        const CoatPreset& preset = preset_of(o->preset);
        s.coat = preset.coat;
        if (o->height > 0) s.coat.length = static_cast<float>(o->height / 100);
        for (const FurMode& m : fur_modes)
            if (m.id == o->mode) s.mode = m.kind;
        const bool classic = s.mode == FurKind::classic, lapped = s.mode == FurKind::lapped;
        if (!classic) {
            if (o->density > 0) s.coat.strands = std::max(1.0f, s.coat.strands * static_cast<float>(o->density / 100));
            for (const std::string& setting : o->set) set_knob(s.coat, setting);
        }
        if (o->layers != "auto") {
            const auto [end, fault] = std::from_chars(o->layers.data(), o->layers.data() + o->layers.size(), s.layers);
            if (fault != std::errc{} || end != o->layers.data() + o->layers.size() || s.layers < 1 || s.layers > 64)
                throw UsageError("--layers takes auto or a number from 1 to 64, not \"" + o->layers + "\"");
        }
        s.width = o->size[0];
        s.height = o->size[1];
        if (s.width < 16 || s.height < 16 || s.width > 16384 || s.height > 16384) throw UsageError("--size takes 16 to 16384 pixels a side");
        const std::vector<int> passes = pass_counts(o->passes);
        s.passes = passes.back();
        s.film.passes = passes;
        s.device = o->device;
        s.measure = o->json;
        if (!o->reference.empty()) s.reference_samples = s.film.samples = o->samples;
        s.growth = {.lengths = length_rules_of(o->growth), .comb = comb_paint_of(o->growth.comb)};
        take_forces(o->growth, s);
        std::string words = o->in + ' ' + o->mode + ' ' + std::string(preset.id) + " layers " + o->layers + " size " + std::to_string(s.width) + ' ' + std::to_string(s.height) + " passes " + std::to_string(s.passes);
        for (const CoatKnob& k : coat_knobs()) words += ' ' + std::string(k.id) + ' ' + std::to_string(s.coat.*k.member);
        for (const std::string& rule : o->growth.where) words += ' ' + rule;
        if (!o->growth.comb.empty()) words += " comb " + o->growth.comb;
        for (const double force : {s.forces.gravity.y, s.forces.wind.x, s.forces.wind.y, s.forces.wind.z}) words += ' ' + std::to_string(force);
        std::error_code none;
        if (const auto bytes = std::filesystem::file_size(o->in, none); !none) words += " bytes " + std::to_string(bytes);
        take_film(o->growth, o->out, words, s);
        if ((classic || lapped) && (!s.growth.lengths.empty() || length(s.forces.gravity) > 0 || length(s.forces.wind) > 0 || s.film.frames > 0))
            throw UsageError("--grow-where, --gravity, --wind, --animate and --turntable are for strands, not for --mode " + o->mode);
        if (passes.size() > 1 && (s.film.frames == 0 || s.film.samples == 0))
            throw UsageError("several numbers of --passes are told apart by how steady they are: that takes --turntable or --animate, and --reference");
        if (!o->growth.exported.empty()) {
            if (o->mode != "strands") throw UsageError("--export writes strands, which --mode " + o->mode + " has none of");
            export_as_asked(o->in, o->growth, s, o->quiet);
            if (!drawn) return;
        }
        const FurPicture p = classic  ? classic_picture(o->in, classic_settings(o->classic, s, o->height, o->density, o->set), progress_display(o->quiet))
                             : lapped ? lapped_picture(o->in, lapped_settings(o->classic, s), progress_display(o->quiet))
                                      : fur_picture(o->in, s, progress_display(o->quiet));
        if (!o->out.empty()) write_fur_picture(o->out, p.picture);
        if (!o->reference.empty()) write_fur_picture(o->reference, p.beside);
        if (!o->quiet)
            for (const std::string& note : p.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
        if (o->json)
            std::printf("%s\n", fur_json(p, std::string(preset.id), o->out).dump(2).c_str());
        else if (p.steadiness)
            std::fputs(steadiness_text(*p.steadiness).c_str(), stdout);
        else if (!o->quiet)
            std::fprintf(stderr, "%s: %zu strands on %zu faces, %d layers, first frame after %.0f ms, then %.0f ms each\n", o->out.c_str(), p.strands, p.faces, p.layers,
                         p.ms.first_frame, p.ms.frame_median);
    });
}

}  // namespace relievo
