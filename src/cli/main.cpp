// relievo: exit code 0 done, 1 the work failed, 2 the command was wrong, 130 interrupted. Messages on standard error.
#include "cli/commands.h"
#include "cli/interrupt.h"
#include "core/error.h"
#include "core/suggest.h"
#include "core/version.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

namespace {

constexpr const char* examples =
    "Examples:\n"
    "  relievo compare --out report                      every technique on the procedural materials\n"
    "  relievo compare --material ~/textures/wall --view grazing --out report\n"
    "  relievo render --material ~/textures/wall --technique relief_mapping --set max_steps=64 --out wall.png\n"
    "  relievo explain --material cobbles --technique relief_mapping,cone_step_mapping --view grazing --out ray.svg\n"
    "  relievo bake --material ~/textures/wall --map cone --out wall_cone.exr\n"
    "  relievo mesh bunny.obj --centre --normals --index --order --out bunny.rmesh\n"
    "  relievo fur bunny.obj --out bunny.png\n"
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

// The first word of a command line that did not parse which is no command, or no option of its command, with a suggestion; empty
// when the mistake is another one.
std::string misspelt_word(CLI::App& app, int argc, char** argv) {
    const std::string first = argv[1];
    const CLI::App* verb = &app;
    if (first[0] != '-') {
        std::vector<std::string> verbs;
        for (const CLI::App* v : app.get_subcommands({})) verbs.push_back(v->get_name());
        if (std::ranges::find(verbs, first) == verbs.end()) return relievo::unknown_word("command", first, verbs);
        verb = app.get_subcommand(first);
        // Commands of two words: `compare fur`.
        const std::string second = argc > 2 ? argv[2] : "";
        for (const CLI::App* v : verb->get_subcommands({}))
            if (v->get_name() == second) verb = v;
    }
    std::vector<std::string> known;
    for (const CLI::Option* option : verb->get_options())
        for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    for (int i = 1; i < argc; ++i) {
        const std::string word = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
        if (word.starts_with("--") && word != "--" && std::ranges::find(known, word) == known.end())
            return relievo::unknown_word("option", word, known);
    }
    return {};
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
    relievo::add_explain_command(app);
    relievo::add_effects_command(app);
    relievo::add_replicate_command(app, {joined(argc, argv)});
    relievo::add_bake_command(app);
    relievo::add_mesh_command(app);
    relievo::add_fur_command(app);
    relievo::add_report_command(app);
    relievo::add_list_command(app);
    relievo::add_vary_command(app);
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
        const std::string slip = misspelt_word(app, argc, argv);
        std::fprintf(stderr, "relievo: %s\nSee relievo --help, or relievo COMMAND --help.\n", slip.empty() ? e.what() : slip.c_str());
        return 2;
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    relievo::catch_interrupts();
    try {
        const int code = run(argc, argv);
        // A full disk or a closed pipe must not pass for success.
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
            std::fprintf(stderr, "relievo: cannot write to standard output: %s\n", std::strerror(errno));
            return 1;
        }
        return code;
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
