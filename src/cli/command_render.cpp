#include "cli/commands.h"

#include "cli/material_options.h"
#include "cli/options.h"
#include "cli/progress_display.h"
#include "core/error.h"
#include "pipeline/compare.h"
#include "pipeline/render_picture.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

namespace relievo {

namespace {

nlohmann::ordered_json mesh_json(const MeshFacts& facts) {
    nlohmann::ordered_json json{{"faces", facts.faces}, {"charts", facts.charts}, {"judged", facts.judged}, {"holes", facts.holes}, {"holes_filled", facts.holes_filled}};
    json["missed_first_hit"] = facts.missed_first_hit ? nlohmann::ordered_json(*facts.missed_first_hit) : nlohmann::ordered_json(nullptr);
    json["early_hit"] = facts.early_hit ? nlohmann::ordered_json(*facts.early_hit) : nlohmann::ordered_json(nullptr);
    json["uv_error_texels"] = facts.uv_error_texels ? nlohmann::ordered_json{{"p50", facts.uv_error_texels->p50}, {"p99", facts.uv_error_texels->p99}, {"max", facts.uv_error_texels->max}} : nlohmann::ordered_json(nullptr);
    return json;
}

}  // namespace

void add_render_command(CLI::App& app) {
    struct Options {
        RenderSettings settings;
        std::string technique, view = "middle", size = "1280x720";
        std::vector<std::string> set;
        int samples = 5;
        bool no_cache = false, json = false, quiet = false;
    };
    auto o = std::make_shared<Options>();
    auto* verb = app.add_subcommand("render", "Draws one picture of a material by one technique");
    add_material_options(*verb, o->settings.material);
    verb->add_option("--technique", o->technique, "id (relievo list techniques), or 'reference' for the exact picture")->required();
    verb->add_option("--set", o->set, "knob=value; may be repeated (relievo list knobs)");
    verb->add_option("--view", o->view, "grazing, middle, steep or degrees above the plane, and @2 for twice as far away")->capture_default_str();
    verb->add_option("--mesh", o->settings.mesh, "put the relief on an unwrapped mesh: cube, cylinder, torus, or a file with texture coordinates; searched on the CPU");
    verb->add_option("--repeats", o->settings.repeats, "repeats of the material over the mesh's texture square")->check(CLI::Range(0.01, 1000.0))->capture_default_str();
    verb->add_option("--size", o->size, "picture size, WIDTHxHEIGHT")->capture_default_str();
    verb->add_option("--samples", o->samples, "samples per pixel: 1, 5, 9 or 25")->check(CLI::IsMember({1, 5, 9, 25}))->capture_default_str();
    add_modifier_options(*verb, o->settings.picture.options);
    verb->add_option("--device", o->settings.device, "software, or part of a device's name (relievo list devices)");
    verb->add_flag("--no-cache", o->no_cache, "bake every map anew");
    verb->add_flag("--quiet", o->quiet, "no progress and no notes");
    verb->add_flag("--json", o->json, "print what was drawn as JSON");
    verb->add_option("--out", o->settings.out, "FILE.png: the picture; FILE.exr: colour, hit UV, height, normal, shadow, fetches and mask")->required();
    verb->footer("Examples:\n  relievo render --material cobbles --technique relief_mapping --view grazing --out cobbles.png\n"
                 "  relievo render --material wall --technique cone_step_mapping --set max_steps=32 --view 20 --out wall.exr\n"
                 "  relievo render --mesh torus --repeats 4 --border chart --material cobbles --technique cell_cone_tracing --out torus.png");
    verb->callback([o] {
        RenderSettings& s = o->settings;
        if (o->technique != "reference") {
            s.technique = &parse_technique(o->technique, {"reference"});
            s.params = parse_knobs(*s.technique, o->set);
        } else if (!o->set.empty()) {
            throw UsageError("the reference is exact and has no knobs, so --set does nothing");
        }
        const auto chosen = parse_views({o->view});
        if (chosen.size() != 1) throw UsageError("render draws one view; --view names " + std::to_string(chosen.size()));
        s.view = chosen.front();
        const Size size = parse_size(o->size);
        s.picture.width = size.width;
        s.picture.height = size.height;
        s.picture.offsets = sample_offsets(o->samples);
        s.use_cache = !o->no_cache;
        const RenderedPicture picture = render_picture(s, progress_display(o->quiet));
        if (!o->quiet)
            for (const std::string& note : picture.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
        if (o->json) {
            nlohmann::ordered_json json{{"image", s.out},
                                        {"technique", o->technique},
                                        {"view", s.view.id},
                                        {"elevation_deg", s.view.elevation_deg},
                                        {"size", {size.width, size.height}},
                                        {"source", picture.source},
                                        {"fetches_mean", picture.mean_fetches},
                                        {"notes", picture.notes}};
            if (picture.mesh) json["mesh"] = mesh_json(*picture.mesh);
            std::printf("%s\n", json.dump(2).c_str());
        }
    });
}

}  // namespace relievo
