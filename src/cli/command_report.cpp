#include "cli/commands.h"

#include "pipeline/write_report.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <string>

namespace relievo {

void add_report_command(CLI::App& app) {
    auto path = std::make_shared<std::string>();
    auto* verb = app.add_subcommand("report", "Writes the page and the table again from a results.json");
    verb->add_option("results", *path, "results.json, or the folder that holds it")->required();
    verb->footer("Example:\n  relievo report out/report/results.json");
    verb->callback([path] { std::fprintf(stderr, "Report: %s\n", rewrite_report(*path).c_str()); });
}

}  // namespace relievo
