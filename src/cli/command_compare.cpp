#include "cli/commands.h"

#include "cli/options.h"
#include "cli/progress_display.h"
#include "core/error.h"
#include "pipeline/compare.h"
#include "report/results.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

namespace relievo {

void add_compare_command(CLI::App& app, const CommandLine& command_line) {
    struct Options {
        CompareSettings settings;
        std::vector<std::string> materials, techniques, views;
        std::string size = "352x198";
        int texels = 512;
        bool no_cache = false, sweep = false, no_sweep = false, quiet = false, json = false;
    };
    auto o = std::make_shared<Options>();
    o->settings.command = command_line.text;
    auto* verb = app.add_subcommand("compare", "Scores techniques on materials and views against exact ground truth and writes a report; with fur: ways of growing it");
    verb->add_option("--material", o->materials, "folder with maps, or a procedural material's id; may be repeated (default: the procedural set)");
    verb->add_option("--technique", o->techniques, "ids, comma-separated or repeated (default: all)");
    verb->add_option("--view", o->views, "grazing, middle, steep or degrees above the plane, and @2 for twice as far away; may be repeated (default: the three)");
    verb->add_option("--size", o->size, "picture size, WIDTHxHEIGHT")->capture_default_str();
    verb->add_option("--runs", o->settings.runs, "timed runs of each technique, interleaved")->check(CLI::Range(1, 10000))->capture_default_str();
    verb->add_option("--samples", o->settings.samples, "samples per pixel of pictures and reference: 1, 5, 9 or 25")
        ->check(CLI::IsMember({1, 5, 9, 25}))
        ->capture_default_str();
    add_modifier_options(*verb, o->settings.options);
    verb->add_option("--texels", o->texels, "edge of the procedural materials' maps")->check(CLI::Range(1, 8192))->capture_default_str();
    verb->add_option("--device", o->settings.device, "software, or part of a device's name (relievo list devices)");
    verb->add_option("--threads", o->settings.threads, "threads of the CPU work (0: all cores)")->check(CLI::NonNegativeNumber);
    auto* sweep = verb->add_flag("--sweep", o->sweep, "each technique at an eighth to eight times its budget, in every view (default: half and twice, in the first view)");
    verb->add_flag("--no-sweep", o->no_sweep, "only the default knobs: no curves, no equal-error table")->excludes(sweep);
    verb->add_flag("--no-cache", o->no_cache, "bake every map anew");
    verb->add_flag("--validation", o->settings.validation, "run with the Vulkan validation layers; their messages are an error");
    verb->add_flag("--quiet", o->quiet, "no progress");
    verb->add_flag("--json", o->json, "print the results as JSON on standard output as well");
    verb->add_option("--out", o->settings.out, "folder for index.html, results.json, results.csv and the pictures (required)");
    verb->footer("Examples:\n  relievo compare --out report\n"
                 "  relievo compare --material wall --material floor --technique relief_mapping,cone_step_mapping --view 20 --out report\n"
                 "  relievo compare --material cobbles --size 1280x720 --runs 31 --out report\n"
                 "  relievo compare --material cobbles --sweep --out report");
    add_compare_fur_command(*verb, command_line);
    verb->callback([o, verb] {
        if (!verb->get_subcommands().empty()) return;  // another comparison
        CompareSettings& s = o->settings;
        if (s.out.empty()) throw UsageError("compare needs --out FOLDER for its report");
        const Size size = parse_size(o->size);
        s.width = size.width;
        s.height = size.height;
        s.techniques = parse_techniques(o->techniques);
        s.views = parse_views(o->views);
        require_front(s.views, "compare");
        s.use_cache = !o->no_cache;
        s.sweep = o->sweep ? Sweep::full : o->no_sweep ? Sweep::none : Sweep::small;
        if (o->materials.empty())
            for (const Scene& scene : scenes()) o->materials.emplace_back(scene.id);
        for (const std::string& folder : o->materials)
            s.materials.push_back({.folder = folder, .procedural_size = o->texels, .threads = s.threads});
        const Results results = compare(s, progress_display(o->quiet));
        if (o->json) std::printf("%s\n", results_json(results).c_str());
        if (!o->quiet) std::fprintf(stderr, "Report: %s/index.html\n", s.out.c_str());
    });
}

}  // namespace relievo
