#include "cli/growth_options.h"

#include "cli/progress_display.h"
#include "pipeline/fur_export.h"

#include <CLI/CLI.hpp>
#include <cstdio>

namespace relievo {

void add_growth_options(CLI::App& verb, GrowthOptions& options) {
    verb.add_option("--grow-where", options.where, "NAME=FROM..TO@ARGUMENT, a rule of length: bare where NAME is FROM, full length where it is TO; several multiply")->take_all();
    verb.add_option("--export", options.exported, "FILE.hair, FILE.obj or FILE.ply: the strands as curves, in the mesh's own space and units; may be repeated")->take_all();
    verb.add_option("--pieces", options.pieces, "straight pieces of each exported strand")->check(CLI::Range(1, 1024))->capture_default_str();
}

std::vector<LengthRule> length_rules_of(const GrowthOptions& options) {
    std::vector<LengthRule> rules;
    for (const std::string& text : options.where) rules.push_back(length_rule(text));
    return rules;
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
    const FurExport e = export_fur(mesh, options.exported, {.coat = fur.coat, .lengths = fur.lengths, .pieces = options.pieces, .threads = fur.threads}, progress_display(quiet));
    if (quiet) return;
    for (const std::string& file : options.exported) std::fprintf(stderr, "%s: %zu strands of %zu points\n", file.c_str(), e.strands, e.points);
}

}  // namespace relievo
