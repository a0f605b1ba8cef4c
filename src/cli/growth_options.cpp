#include "cli/growth_options.h"

#include "cli/progress_display.h"
#include "core/error.h"
#include "pipeline/fur_export.h"
#include "pipeline/fur_path.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

namespace relievo {

void add_comb_option(CLI::App& verb, std::string& comb) {
    verb.add_option("--comb", comb, "FILE, a picture over the mesh's texture coordinates that combs the fur: a flow map in tangent space, red along u and green along v about 128, with its weight in alpha, or in blue without alpha; or colours: those of the vertices, a direction in space about mid-grey. Where the weight is 0 the fur lies as without");
}

void add_growth_options(CLI::App& verb, GrowthOptions& options) {
    verb.add_option("--grow-where", options.where, "NAME=FROM..TO@ARGUMENT, a rule of length: bare where NAME is FROM, full length where it is TO; several multiply")->take_all();
    add_comb_option(verb, options.comb);
    verb.add_option("--gravity", options.gravity, "how strongly fur hangs down, in units of earth's gravity, beyond what its comb has of it")->check(CLI::Range(-20.0, 20.0))->capture_default_str();
    verb.add_option("--wind", options.wind, "X Y Z, pull of the wind on the strands, in the same unit")->expected(3);
    verb.add_option("--gusts", options.gusts, "by which share of itself the wind swells and falls in an animation")->check(CLI::Range(0.0, 1.0))->capture_default_str();
    verb.add_option("--animate", options.frames, "so many frames of 1/25 s, as FILE_0000.png and on beside --out FILE.png: the wind sets in, the fur swings. With --reference, --json says how steady they are")->check(CLI::Range(1, 9999));
    verb.add_option("--spin", options.spin, "turns a second of the mesh around its vertical axis in an animation")->check(CLI::Range(-20.0, 20.0));
    verb.add_option("--turntable", options.turntable, "so many frames around the mesh, as FILE_0000.png and on beside --out FILE.png; begun again with the same words, it goes on. With --reference, --json says how steady they are")->check(CLI::Range(1, 9999));
    verb.add_option("--turn", options.turn, "degrees that the turntable turns in all (default: 360, or 0 with --dolly)")->check(CLI::Range(-36000.0, 36000.0));
    verb.add_option("--dolly", options.dolly, "NEAR:FAR, times the distance of the picture from which the first and the last frame of --turntable or --animate are seen, with steps by equal factors; either may be the larger");
    verb.add_option("--export", options.exported, "FILE.hair, FILE.obj or FILE.ply: the strands as curves; FILE.glb: layers with a texture (--layers; auto: 12 to 32). In the mesh's own space and units; may be repeated")->take_all();
    verb.add_option("--atlas", options.atlas, "texels a side of a .glb's texture (2048, or 4096 where strands are thin)")->check(CLI::Range(64, 16384));
    verb.add_option("--pieces", options.pieces, "straight pieces of each exported strand")->check(CLI::Range(1, 1024))->capture_default_str();
}

std::vector<LengthRule> length_rules_of(const GrowthOptions& options) {
    std::vector<LengthRule> rules;
    for (const std::string& text : options.where) rules.push_back(length_rule(text));
    return rules;
}

CombPaint comb_paint_of(const std::string& comb) {
    if (comb == "colours") return {.file = {}, .picture = {}, .colours = true};
    return {.file = comb, .picture = {}, .colours = false};
}

namespace {

std::filesystem::path numbered(const std::filesystem::path& path, int frame) {
    char number[16];
    std::snprintf(number, sizeof number, "_%04d", frame);
    return path.parent_path() / (path.stem().string() + number + path.extension().string());
}

FurDolly dolly_of(const std::string& text) {
    FurDolly dolly;
    const std::size_t colon = text.find(':');
    const auto distance = [&](std::string_view part, double& to) {
        const auto [end, fault] = std::from_chars(part.data(), part.data() + part.size(), to);
        return fault == std::errc{} && end == part.data() + part.size() && to >= nearest_dolly && to <= 100;
    };
    if (colon == std::string::npos || !distance(std::string_view(text).substr(0, colon), dolly.first) || !distance(std::string_view(text).substr(colon + 1), dolly.last)) {
        char message[160];
        std::snprintf(message, sizeof message, "--dolly takes NEAR:FAR, from %g to 100 times the distance of the picture, not \"", nearest_dolly);
        throw UsageError(message + text + "\"");
    }
    return dolly;
}

}  // namespace

void take_forces(const GrowthOptions& options, FurSettings& settings) {
    settings.forces.gravity = {0, -options.gravity, 0};
    if (!options.wind.empty()) settings.forces.wind = {options.wind[0], options.wind[1], options.wind[2]};
    if (!(length(settings.forces.wind) <= 100)) throw UsageError("--wind takes a pull of at most 100 times gravity");
}

void take_film(const GrowthOptions& options, const std::string& out, const std::string& words, FurSettings& settings) {
    if (options.turntable > 0 && options.frames > 0) throw UsageError("--turntable and --animate number their frames alike: take one of them");
    const char* const filmed = options.frames > 0 ? "--animate" : "--turntable";
    FurFilm& film = settings.film;
    film.frames = std::max(options.frames, options.turntable);
    if (options.spin != 0 && options.frames == 0) throw UsageError("--spin turns an animation: it needs --animate FRAMES");
    if (film.frames == 0) {
        if (!options.dolly.empty()) throw UsageError("--dolly moves the camera from frame to frame: it needs --turntable FRAMES or --animate FRAMES");
        return;
    }
    if (out.empty() && film.samples == 0) throw UsageError(std::string(filmed) + " needs --out FILE.png, beside which its frames go, or --reference to measure how steady they are");
    if (!options.dolly.empty()) film.dolly = dolly_of(options.dolly);
    const std::filesystem::path path(out);
    if (!out.empty()) film.shown = [path](int frame, const Image8& picture) { write_fur_picture(numbered(path, frame), picture); };
    if (options.frames > 0) {
        film.swings = true;
        film.turns_per_second = options.spin;
        settings.forces.gusts = options.gusts;
        return;
    }
    film.degrees = options.turn.value_or(options.dolly.empty() ? 360 : 0);
    if (out.empty()) return;
    const std::filesystem::path note = path.parent_path() / (path.stem().string() + "_turntable.txt");
    std::string text = words + "\nturntable " + std::to_string(options.turntable) + " turn " + std::to_string(film.degrees);
    if (!options.dolly.empty()) text += " dolly " + options.dolly;
    text += "\n";
    // Frames are kept where the note beside them says that they are of the same words.
    std::string noted;
    if (std::ifstream in(note, std::ios::binary); in) noted.assign(std::istreambuf_iterator<char>(in), {});
    if (noted != text) {
        for (int frame = 0; frame < options.turntable; ++frame) std::filesystem::remove(numbered(path, frame));
        std::ofstream file(note, std::ios::binary);
        file << text;
        if (!file.flush()) throw Error("write", note.string(), "it cannot be written", "name a folder that exists and may be written to (--out)");
    }
    film.wanted = [path](int frame) { return !std::filesystem::exists(numbered(path, frame)); };
}

std::string length_rule_list() {
    std::string text = "Rules of length (--grow-where NAME, NAME=FROM..TO, with @ARGUMENT for some):\n";
    for (const LengthQuantityEntry& q : length_quantities()) {
        char line[256];
        std::snprintf(line, sizeof line, "  %-10s %4g..%-4g %s\n", std::string(q.id).c_str(), q.from, q.to, std::string(q.help).c_str());
        text += line;
    }
    return text;
}

void export_as_asked(const std::string& mesh, const GrowthOptions& options, const FurSettings& fur, bool quiet) {
    const FurExport e = export_fur(mesh, options.exported, {.coat = fur.coat, .growth = fur.growth, .forces = fur.forces, .pieces = options.pieces, .layers = fur.layers, .atlas = options.atlas, .threads = fur.threads}, progress_display(quiet));
    if (quiet) return;
    for (const std::string& file : options.exported)
        if (std::filesystem::path(file).extension() == ".glb")
            std::fprintf(stderr, "%s: %zu layers\n", file.c_str(), e.layers);
        else
            std::fprintf(stderr, "%s: %zu strands of %zu points\n", file.c_str(), e.strands, e.points);
    for (const std::string& note : e.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
}

}  // namespace relievo
