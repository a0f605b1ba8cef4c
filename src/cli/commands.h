// The verbs of the command line. Each adds itself to the parser and does its work when chosen.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace relievo {

// The command line as typed, for manifests.
struct CommandLine {
    std::string text;
};

void add_list_command(CLI::App& app);
void add_render_command(CLI::App& app);
void add_compare_command(CLI::App& app, const CommandLine& command_line);
void add_compare_fur_command(CLI::App& compare, const CommandLine& command_line);  // a subcommand of compare
void add_explain_command(CLI::App& app);
void add_effects_command(CLI::App& app);
void add_replicate_command(CLI::App& app, const CommandLine& command_line);
void add_replicate_fur_command(CLI::App& replicate, const CommandLine& command_line);  // a subcommand of replicate
void add_bake_command(CLI::App& app);
void add_mesh_command(CLI::App& app);
void add_fur_command(CLI::App& app);
void add_report_command(CLI::App& app);
void add_view_command(CLI::App& app);
void add_vary_command(CLI::App& app);
void add_docs_command(CLI::App& app);

}  // namespace relievo
