#include "cli/commands.h"

#include "cli/growth_options.h"
#include "cli/options.h"
#include "cli/progress_display.h"
#include "core/error.h"
#include "core/suggest.h"
#include "pipeline/compare_fur.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

namespace relievo {

namespace {

// The entries of a table that the words name; all of it where there are none.
template <class Entry, class Table>
std::vector<Entry> chosen(const Table& table, const std::vector<std::string>& words, const char* kind) {
    std::vector<Entry> entries;
    std::vector<std::string> known;
    for (const auto& e : table) known.emplace_back(e.id);
    for (const std::string& word : words)
        if (std::ranges::find(known, word) == known.end()) throw UsageError(unknown_word(kind, word, known));
    for (const auto& e : table)
        if (words.empty() || std::ranges::find(words, e.id) != words.end()) entries.push_back(e);
    return entries;
}

}  // namespace

void add_compare_fur_command(CLI::App& compare, const CommandLine& command_line) {
    struct Options {
        CompareFurSettings settings;
        std::vector<std::string> meshes, modes, presets;
        std::string size = "640x400", comb;
        bool quiet = false, json = false;
    };
    auto o = std::make_shared<Options>();
    o->settings.command = command_line.text;
    auto* verb = compare.add_subcommand("fur", "Scores ways of growing fur on meshes against the same strands as curves, ray traced, and writes a report");
    verb->add_option("meshes", o->meshes, "files: OBJ, PLY, OFF, STL, glTF, GLB or our cache, each also as .gz")->required();
    verb->add_option("--mode", o->modes, "ids, comma-separated or repeated (default: all; relievo list fur)")->delimiter(',')->take_all();
    verb->add_option("--preset", o->presets, "coats, comma-separated or repeated (default: the first)")->delimiter(',')->take_all();
    add_comb_option(*verb, o->comb);
    verb->add_option("--layers", o->settings.layers, "of every mode (default: what each chooses by itself)")->check(CLI::Range(1, 64));
    verb->add_option("--size", o->size, "picture size, WIDTHxHEIGHT")->capture_default_str();
    verb->add_option("--passes", o->settings.passes, "frames averaged into each picture")->check(CLI::Range(1, 1024))->capture_default_str();
    verb->add_option("--samples", o->settings.samples, "rays a pixel of the traced strands")->check(CLI::Range(1, 4096))->capture_default_str();
    verb->add_option("--device", o->settings.device, "software, or part of a device's name (relievo list devices)");
    verb->add_option("--threads", o->settings.threads, "threads of the CPU work (0: all cores)")->check(CLI::NonNegativeNumber);
    verb->add_flag("--quiet", o->quiet, "no progress");
    verb->add_flag("--json", o->json, "print the results as JSON instead of a table");
    verb->add_option("--out", o->settings.out, "folder for index.html, results.json, results.csv and the pictures")->required();
    verb->footer("Examples:\n  relievo compare fur bunny.obj --out report\n"
                 "  relievo compare fur bunny.obj dragon.ply.gz --mode strands,classic --preset rabbit,fox --size 1280x800 --samples 64 --out report\n"
                 "  relievo compare fur cow.obj --layers 16 --out report\n"
                 "  relievo compare fur spot.obj --comb swirl.png --out report");
    verb->callback([o] {
        CompareFurSettings& s = o->settings;
        const Size size = parse_size(o->size);
        s.width = size.width;
        s.height = size.height;
        for (const FurMode& m : chosen<FurMode>(fur_modes, o->modes, "mode")) s.modes.push_back(m.kind);
        s.presets = chosen<CoatPreset>(coat_presets(), o->presets, "preset");
        if (o->presets.empty()) s.presets.resize(1);
        s.comb = comb_paint_of(o->comb);
        for (const std::string& mesh : o->meshes) s.meshes.emplace_back(mesh);
        const FurComparison comparison = compare_fur(s, progress_display(o->quiet));
        std::fputs(o->json ? fur_comparison_json(comparison).c_str() : fur_comparison_text(comparison).c_str(), stdout);
        if (!o->quiet) std::fprintf(stderr, "Report: %s/index.html\n", s.out.c_str());
    });
}

}  // namespace relievo
