#include "cli/growth_options.h"

#include "cli/progress_display.h"
#include "pipeline/fur_export.h"

#include <CLI/CLI.hpp>
#include <cstdio>

namespace relievo {

void add_growth_options(CLI::App& verb, GrowthOptions& options) {
    verb.add_option("--export", options.exported, "FILE.hair, FILE.obj or FILE.ply: the strands as curves, in the mesh's own space and units; may be repeated")->take_all();
    verb.add_option("--pieces", options.pieces, "straight pieces of each exported strand")->check(CLI::Range(1, 1024))->capture_default_str();
}

void export_as_asked(const std::string& mesh, const GrowthOptions& options, const FurSettings& fur, bool quiet) {
    const FurExport e = export_fur(mesh, options.exported, {.coat = fur.coat, .pieces = options.pieces, .threads = fur.threads}, progress_display(quiet));
    if (quiet) return;
    for (const std::string& file : options.exported) std::fprintf(stderr, "%s: %zu strands of %zu points\n", file.c_str(), e.strands, e.points);
}

}  // namespace relievo
