// relievo: exit code 0 done, 1 the work failed, 2 the command was wrong, 130 interrupted. Messages on standard error.
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "core/error.h"
#include "core/suggest.h"
#include "core/version.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <string>
#include <vector>

namespace {

constexpr const char* examples =
    "Examples:\n"
    "  relievo compare --out report                      every technique on the procedural materials\n"
    "  relievo compare --material ~/textures/wall --view grazing --out report\n"
    "  relievo render --material ~/textures/wall --technique relief_mapping --set max_steps=64 --out wall.png\n"
    "  relievo bake --material ~/textures/wall --map cone --out wall_cone.exr\n"
    "  relievo view --material ~/textures/wall\n"
    "  relievo list techniques";

std::string joined(int argc, char** argv) {
    std::string text = "relievo";
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        text += word.find_first_of(" \t\"'\\$") == std::string::npos && !word.empty() ? " " + word : " '" + word + "'";
    }
    return text;
}

int run(int argc, char** argv) {
    CLI::App app{"relievo compares the techniques that make a flat polygon look carved against exact ground truth."};
    app.name("relievo");
    app.footer(examples);
    app.set_version_flag("--version", "relievo " + std::string(relievo::version));
    app.require_subcommand(1);
    relievo::add_compare_command(app, {joined(argc, argv)});
    relievo::add_render_command(app);
    relievo::add_view_command(app);
    relievo::add_bake_command(app);
    relievo::add_report_command(app);
    relievo::add_list_command(app);
    relievo::add_docs_command(app);
    if (argc == 1) {
        std::fputs(app.help().c_str(), stderr);
        return 2;
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& e) {  // --help, --version
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        std::string hint;
        if (argc > 1 && argv[1][0] != '-') {
            std::vector<std::string> verbs;
            for (const CLI::App* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
            if (std::find(verbs.begin(), verbs.end(), argv[1]) == verbs.end()) hint = relievo::unknown_word("command", argv[1], verbs);
        }
        std::fprintf(stderr, "relievo: %s\nSee relievo --help, or relievo COMMAND --help.\n", hint.empty() ? e.what() : hint.c_str());
        return 2;
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    relievo::catch_interrupts();
    try {
        return run(argc, argv);
    } catch (const relievo::UsageError& e) {
        std::fprintf(stderr, "relievo: %s\n", e.what());
        return 2;
    } catch (const relievo::Cancelled&) {
        std::fprintf(stderr, "\nrelievo: interrupted; nothing half-written was left behind\n");
        return 130;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "relievo: out of memory; try smaller maps or a smaller --size\n");
        return 1;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "relievo: %s\n", e.what());
        return 1;
    }
}
