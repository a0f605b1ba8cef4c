#include "cli/commands.h"

#include "cli/material_options.h"
#include "cli/options.h"
#include "cli/progress_display.h"
#include "core/error.h"
#include "explain/search_figure.h"
#include "pipeline/explain_ray.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

namespace relievo {

namespace {

using Json = nlohmann::ordered_json;

// "X,Y" of two numbers; `what` names the option.
template <class T>
Vec2<T> parse_pair(const std::string& what, const std::string& text, const char* format, const std::string& example) {
    Vec2<T> pair;
    int read = 0;
    if (std::sscanf(text.c_str(), format, &pair.x, &pair.y, &read) != 2 || read != static_cast<int>(text.size()))
        throw UsageError(what + " '" + text + "' is not two numbers with a comma, as in " + example);
    return pair;
}

constexpr const char* kind_ids[] = {"sample", "bisection", "secant", "cone", "sphere", "node", "cell", "normal", "other"};

Json search_json(const Search& s) {
    Json knobs = Json::object();
    for (const KnobDefault& k : s.technique->knobs) knobs[std::string(k.knob->id)] = k.knob->get(s.params);
    Json steps = Json::array();
    for (const Step& step : s.steps) {
        Json one{{"kind", kind_ids[static_cast<int>(step.kind)]}, {"texels", step.x}, {"ray_height", step.z}, {"value", step.value}};
        if (step.kind == StepKind::node || step.kind == StepKind::cell) {
            one["texels_end"] = step.x_end;
            one["level"] = step.size;
            one["passed_over"] = step.skipped;
        }
        steps.push_back(std::move(one));
    }
    return {{"technique", s.technique->id}, {"knobs", knobs}, {"fetches", s.fetches}, {"found", s.has_found}, {"height", s.found.z},
            {"texels", s.found.x}, {"error_texels", s.texels_off}, {"steps", steps}};
}

Json explained_json(const ExplainSettings& settings, const Explained& e) {
    const RayQuestion& q = e.section.question;
    Json json{{"ray", {{"uv", {q.uv.x, q.uv.y}}, {"view", {q.view.x, q.view.y, q.view.z}}, {"height_scale", q.height_scale}, {"zero_level", q.zero_level}}},
              {"truth", {{"height", e.section.truth.z}, {"texels", e.section.truth.x}}},
              {"searches", Json::array()}};
    if (!settings.out.empty()) json["figure"] = settings.out;
    for (const Search& s : e.searches) json["searches"].push_back(search_json(s));
    return json;
}

// Settings go to each technique that has the knob; one that none has is a slip.
void set_knobs(ExplainSettings& settings, const std::vector<std::string>& texts) {
    std::vector<std::vector<std::string>> own(settings.techniques.size());
    for (const std::string& text : texts) {
        const std::string id = text.substr(0, text.find('='));
        bool taken = false;
        for (std::size_t i = 0; i < own.size(); ++i)
            for (const KnobDefault& k : settings.techniques[i].technique->knobs)
                if (k.knob->id == id) {
                    own[i].push_back(text);
                    taken = true;
                }
        if (!taken) parse_knobs(*settings.techniques.front().technique, {text});  // throws, with a suggestion
    }
    for (std::size_t i = 0; i < own.size(); ++i) settings.techniques[i].params = parse_knobs(*settings.techniques[i].technique, own[i]);
}

}  // namespace

void add_explain_command(CLI::App& app) {
    struct Options {
        ExplainSettings settings;
        std::vector<std::string> techniques, set;
        std::string view = "middle", size = "1280x720", pixel, uv, paper;
        bool no_cache = false, json = false, quiet = false;
    };
    auto o = std::make_shared<Options>();
    auto* verb = app.add_subcommand("explain", "Shows every step of techniques on one ray: the section through the field, the true hit, the numbers");
    add_material_options(*verb, o->settings.material);
    verb->add_option("--technique", o->techniques, "ids, comma-separated or repeated (relievo list techniques)")->required();
    verb->add_option("--set", o->set, "knob=value, for every technique that has the knob; may be repeated (relievo list knobs)");
    verb->add_option("--view", o->view, "grazing, middle, steep or degrees above the plane, and @2 for twice as far away")->capture_default_str();
    verb->add_option("--size", o->size, "size of the picture that the pixel is of, WIDTHxHEIGHT")->capture_default_str();
    auto* pixel = verb->add_option("--pixel", o->pixel, "X,Y from the top left corner (default: the middle)");
    auto* uv = verb->add_option("--uv", o->uv, "U,V where the ray meets the polygon, instead of a pixel")->excludes(pixel);
    verb->add_option("--elevation", o->settings.elevation_deg, "of the eye above the plane, degrees; with --uv")->check(CLI::Range(0.5, 90.0))->needs(uv)->capture_default_str();
    verb->add_option("--azimuth", o->settings.azimuth_deg, "of the eye around the normal, degrees counter-clockwise from +u; with --uv")->check(CLI::Range(-360.0, 360.0))->needs(uv)->capture_default_str();
    verb->add_option("--paper", o->paper, "light, dark or, for .svg, either: as the reader's system prefers (default: .svg either, .png light)")
        ->check(CLI::IsMember({"light", "dark", "either"}));
    verb->add_option("--scale", o->settings.scale, "pixels of a .png to one of the figure, which is 1000 wide")->check(CLI::Range(0.25, 8.0))->capture_default_str();
    verb->add_flag("--no-cache", o->no_cache, "bake every map anew");
    verb->add_flag("--quiet", o->quiet, "no progress and no notes");
    verb->add_flag("--json", o->json, "print ray, true hit and every step as JSON");
    verb->add_option("--out", o->settings.out, "FILE.svg or FILE.png (default: only the numbers)");
    verb->footer("Examples:\n  relievo explain --material cobbles --technique relief_mapping,cone_step_mapping,max_mip_tracing --view grazing --out ray.svg\n"
                 "  relievo explain --material wall --technique linear_search --set max_steps=16 --pixel 640,500 --out ray.png\n"
                 "  relievo explain --material spikes --technique cone_step_mapping --uv 0.4,0.7 --elevation 12 --azimuth 30 --json");
    verb->callback([o] {
        ExplainSettings& s = o->settings;
        for (const Technique* t : parse_techniques(o->techniques)) s.techniques.push_back({t, {}});
        set_knobs(s, o->set);
        const auto chosen = parse_views({o->view});
        if (chosen.size() != 1) throw UsageError("explain looks at one view; --view names " + std::to_string(chosen.size()));
        require_front(chosen, "explain");
        s.view = chosen.front();
        const Size size = parse_size(o->size);
        s.width = size.width;
        s.height = size.height;
        if (!o->pixel.empty()) s.pixel = parse_pair<int>("--pixel", o->pixel, "%d,%d%n", "640,360");
        if (!o->uv.empty()) s.uv = parse_pair<double>("--uv", o->uv, "%lf,%lf%n", "0.25,0.5");
        // Farther out a float no longer tells texels apart.
        if (s.uv && !(std::abs(s.uv->x) <= 1000 && std::abs(s.uv->y) <= 1000)) throw UsageError("--uv " + o->uv + ": both between -1000 and 1000");
        const bool png = s.out.ends_with(".png");
        s.paper = o->paper == "dark" ? Paper::dark : o->paper == "light" || (o->paper.empty() && png) ? Paper::light : Paper::either;
        s.use_cache = !o->no_cache;
        const Explained explained = explain_ray(s, progress_display(o->quiet));
        if (!o->quiet)
            for (const std::string& note : explained.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
        if (o->json) {
            std::printf("%s\n", explained_json(s, explained).dump(2).c_str());
        } else {
            std::printf("%s\nFirst hit at height %.3f, %.2f texels from where the ray enters.\n", explained.where.c_str(), explained.section.truth.z, explained.section.truth.x);
            for (const Search& search : explained.searches)
                std::printf("%-28s %s\n", std::string(search.technique->id).c_str(), search_sentence(search).c_str());
        }
    });
}

}  // namespace relievo
