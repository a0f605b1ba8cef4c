#include "cli/commands.h"

#include "cli/progress_display.h"
#include "pipeline/write_docs.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

namespace relievo {

void add_docs_command(CLI::App& app) {
    struct Options {
        DocsSettings settings{.out = "docs/generated", .device = {}};
        bool no_figures = false, quiet = false;
    };
    auto o = std::make_shared<Options>();
    auto* verb = app.add_subcommand("docs", "Writes the chapters, tables and figures of the documentation");
    verb->add_option("--out", o->settings.out, "folder to write to")->capture_default_str();
    verb->add_option("--device", o->settings.device, "software, or part of a device's name (relievo list devices)");
    verb->add_option("--threads", o->settings.threads, "threads to use (0: all cores)")->check(CLI::NonNegativeNumber);
    verb->add_flag("--no-figures", o->no_figures, "only the texts");
    verb->add_flag("--quiet", o->quiet, "no progress");
    verb->footer("Example:\n  relievo docs --out docs/generated");
    verb->callback([o] {
        o->settings.figures = !o->no_figures;
        write_docs(o->settings, progress_display(o->quiet));
        if (!o->quiet) std::fprintf(stderr, "Documentation: %s\n", o->settings.out.c_str());
    });
}

}  // namespace relievo
