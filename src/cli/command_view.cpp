#include "cli/commands.h"

#include "cli/interrupt.h"
#include "cli/material_options.h"
#include "cli/options.h"
#include "cli/progress_display.h"
#include "core/error.h"
#include "viewer/viewer.h"

#include <CLI/CLI.hpp>
#include <memory>

namespace relievo {

void add_view_command(CLI::App& app) {
    struct Options {
        ViewerSettings settings;
        std::string technique = "relief_mapping", view = "middle", size = "1280x720";
    };
    auto o = std::make_shared<Options>();
    o->settings.material.folder = "cobbles";
    auto* verb = app.add_subcommand("view", "Opens a window: orbit the material, turn every knob, split against the reference");
    add_material_options(*verb, o->settings.material);
    verb->add_option("--technique", o->technique, "technique to begin with")->capture_default_str();
    verb->add_option("--view", o->view, "view to begin with")->capture_default_str();
    verb->add_option("--size", o->size, "window size, WIDTHxHEIGHT")->capture_default_str();
    verb->add_option("--device", o->settings.device, "software, or part of a device's name (relievo list devices)");
    verb->add_option("--frames", o->settings.frames, "close after this many frames (0: when the window is closed)")->check(CLI::NonNegativeNumber);
    verb->add_option("--screenshot", o->settings.screenshot, "write the last frame to this PNG on closing");
    verb->add_flag("--split", o->settings.split, "begin with the split against the exact reference");
    verb->add_flag("--validation", o->settings.validation, "run with the Vulkan validation layers; their messages are an error");
    verb->footer("Examples:\n  relievo view\n  relievo view --material ~/textures/wall --technique cone_step_mapping\n"
                 "Drag with the left button to orbit, with the right to move the light; the wheel zooms; Esc closes.");
    verb->callback([o] {
        o->settings.technique = &parse_technique(o->technique);
        const auto chosen = parse_views({o->view});
        if (chosen.size() != 1) throw UsageError("the window begins with one view; --view names " + std::to_string(chosen.size()));
        require_front(chosen, "view");
        o->settings.view = chosen.front();
        const Size size = parse_size(o->size);
        o->settings.width = size.width;
        o->settings.height = size.height;
        o->settings.progress = progress_display(false);
        o->settings.poll = stop_if_interrupted;
        run_viewer(o->settings);
    });
}

}  // namespace relievo
