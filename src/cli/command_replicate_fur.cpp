#include "cli/commands.h"

#include "cli/options.h"
#include "cli/progress_display.h"
#include "core/error.h"
#include "core/suggest.h"
#include "pipeline/replicate_fur.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

namespace relievo {

void add_replicate_fur_command(CLI::App& replicate, const CommandLine& command_line) {
    struct Options {
        ReplicateFurSettings settings;
        std::string size = "1280x800", meshes, state, pictures, page, csv;
        std::vector<std::string> only;
        bool json = false, quiet = false;
    };
    auto o = std::make_shared<Options>();
    const std::string command = command_line.text;
    auto* verb = replicate.add_subcommand("fur", "Runs the eight configurations of the 2009 thesis on fur again, beside strands in object space, both scored against curves");
    verb->add_option("--meshes", o->meshes, "folder with scans that have bunny, dragon, armadillo and buddha in their names (default: made-up scans of their sizes)");
    verb->add_option("--mesh", o->only, "cube, torus, bunny, dragon, armadillo, buddha; comma-separated or repeated (default: all)")->delimiter(',');
    verb->add_option("--height", o->settings.heights, "2 or 5, percent of the radius (default: both)")->delimiter(',')->check(CLI::IsMember({2.0, 5.0}));
    verb->add_option("--density", o->settings.densities, "10 or 20, percent of the map's texels (default: both)")->delimiter(',')->check(CLI::IsMember({10.0, 20.0}));
    verb->add_option("--size", o->size, "picture size, WIDTHxHEIGHT")->capture_default_str();
    verb->add_option("--passes", o->settings.passes, "frames of a round, averaged for coverage")->check(CLI::Range(1, 256))->capture_default_str();
    verb->add_option("--rounds", o->settings.rounds, "all trials in turn, so often")->check(CLI::Range(1, 100))->capture_default_str();
    verb->add_option("--samples", o->settings.samples, "rays a pixel of the reference")->check(CLI::Range(1, 1024))->capture_default_str();
    verb->add_option("--state", o->state, "FILE.json: keeps what is measured, and goes on from there");
    verb->add_option("--seconds", o->settings.seconds, "begin nothing more after so many seconds; run again with the same --state to go on")->check(CLI::NonNegativeNumber);
    verb->add_option("--pictures", o->pictures, "folder: classic, lapped, strands and the reference side by side, of each mesh, height and density");
    verb->add_option("--page", o->page, "FILE.md: also write the page with all tables");
    verb->add_option("--csv", o->csv, "FILE.csv: a line per trial");
    verb->add_option("--device", o->settings.device, "software, or part of a device's name (relievo list devices)");
    verb->add_option("--threads", o->settings.threads, "threads of the CPU work (0: all cores)")->check(CLI::NonNegativeNumber);
    verb->add_flag("--quiet", o->quiet, "no progress");
    verb->add_flag("--json", o->json, "print every number as JSON instead of tables");
    verb->footer("Examples:\n  relievo replicate fur --mesh cube,torus\n  relievo replicate fur --meshes scans --state fur.json --seconds 90\n"
                 "  relievo replicate fur --meshes scans --state fur.json --page docs/replication_fur.md --pictures out/fur");
    verb->callback([o, command] {
        ReplicateFurSettings& s = o->settings;
        const Size size = parse_size(o->size);
        s.width = size.width;
        s.height = size.height;
        for (const std::string& name : o->only) {
            std::vector<std::string> known;
            for (const PublishedFur& p : published_fur()) known.emplace_back(p.mesh);
            if (std::ranges::find(known, name) == known.end()) throw UsageError(unknown_word("mesh", name, known));
            if (std::ranges::find(s.only, name) == s.only.end()) s.only.push_back(name);
        }
        if (!o->page.empty() && !o->page.ends_with(".md")) throw UsageError("--page " + o->page + ": a page is written as .md");
        if (!o->csv.empty() && !o->csv.ends_with(".csv")) throw UsageError("--csv " + o->csv + ": write it as .csv");
        if (!o->state.empty() && !o->state.ends_with(".json")) throw UsageError("--state " + o->state + ": it is kept as .json");
        if (s.seconds > 0 && o->state.empty()) throw UsageError("--seconds leaves work for later, which needs --state FILE.json");
        s.meshes = o->meshes;
        s.state = o->state;
        s.pictures = o->pictures;
        s.page = o->page;
        s.csv = o->csv;
        s.command = command;
        const FurReplication r = replicate_fur(s, progress_display(o->quiet));
        std::fputs(o->json ? fur_replication_json(r).c_str() : fur_replication_text(r).c_str(), stdout);
    });
}

}  // namespace relievo
