#include "pipeline/write_docs.h"

#include "assets/atomic_file.h"
#include "assets/image_file.h"
#include "core/error.h"
#include "core/parallel_for.h"
#include "effects/effects_table.h"
#include "explain/search_figure.h"
#include "figure/svg.h"
#include "fur/fur_modes.h"
#include "heightfield_functions.h"
#include "maps/map_kinds.h"
#include "measure/error_picture.h"
#include "measure/hits.h"
#include "pipeline/compare.h"
#include "pipeline/extrusion_figure.h"
#include "pipeline/fur_chapters.h"
#include "pipeline/fur_figures.h"
#include "pipeline/map_set_bake.h"
#include "pipeline/picture_sheet.h"
#include "pipeline/reference_picture.h"
#include "pipeline/telling_rays.h"
#include "pipeline/vary_modifier.h"
#include "render/cpu_renderer.h"
#include "render/gpu_renderer.h"
#include "report/technique_text.h"
#include "techniques/catalogue.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <sstream>

namespace relievo {

namespace {

namespace fs = std::filesystem;

// The field on which every chapter's numbers are taken: small, so that texts are made in seconds without a device.
constexpr int measured_texels = 256;
constexpr int measured_width = 240;
constexpr int measured_height = 135;
constexpr double measured_elevation_deg = 25;

// The figures' own: large enough to see a texel's error.
constexpr int figure_texels = 512;
constexpr int panel_width = 400;
constexpr int panel_height = 240;
constexpr double figure_elevation_deg = 20;

std::string number(double value, int digits = 2) {
    char text[32];
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    return text;
}

std::string share_text(double share) {
    if (share == 0) return "0";
    return number(share * 100) + " %";
}

// The comment that opens a technique's file: its idea, needs and failures, as its author put them.
std::string opening_comment(std::string_view text) {
    std::string result;
    std::istringstream lines{std::string(text)};
    for (std::string line; std::getline(lines, line) && line.starts_with("//");) {
        line.erase(0, line.starts_with("// ") ? 3 : 2);
        result += line + "\n";
    }
    return result;
}

// The code under that comment.
std::string code_of(std::string_view text) {
    std::string result;
    bool opening = true;
    std::istringstream lines{std::string(text)};
    for (std::string line; std::getline(lines, line);) {
        if (opening && line.starts_with("//")) continue;
        opening = false;
        result += line + "\n";
    }
    return result;
}

std::string map_names(const Technique& t) {
    std::string text;
    for (const Map m : t.maps) {
        if (!text.empty()) text += ", ";
        text += map_kinds()[static_cast<std::size_t>(m)].id;
    }
    return text.empty() ? "none" : text;
}

std::string effect_names(const Effects& e) {
    std::string text;
    const auto add = [&](bool has, const char* name) {
        if (has && !text.empty()) text += ", ";
        if (has) text += name;
    };
    add(e.motion_parallax, "motion parallax");
    add(e.self_occlusion, "self-occlusion");
    add(e.self_shadow, "self-shadow");
    add(e.silhouette, "silhouettes");
    return text.empty() ? "none" : text;
}

// A scene baked once, with the truth that every technique is measured against.
struct Ground {
    const Scene* scene;
    BakedMaps baked;
    RayField rays;
    Frame truth;
};

std::vector<Map> maps_of_all() {
    std::vector<const Technique*> all;
    for (const Technique& t : techniques()) all.push_back(&t);
    return maps_to_draw(all, {});
}

Ground make_ground(const Scene& scene, int texels, int width, int height, double elevation, int threads) {
    Ground ground{&scene, {}, {}, {}};
    ground.baked = bake_maps(load_source({.folder = std::string(scene.id), .procedural_size = texels, .threads = threads}),
                             maps_of_all(), {.threads = threads});
    const Stage stage = stage_for(View{.id = "docs", .elevation_deg = elevation});
    ground.rays = quad_rays(stage, width, height, {0, 0});
    ground.truth = reference_picture(stage, ground.baked.maps, {&ground.rays, 1},
                                     {.height_scale = ground.baked.height_scale, .zero_level = ground.baked.zero_level, .threads = threads});
    return ground;
}

struct SceneErrors {
    double missed, early, p99, fetches;
    TellingRays rays;
};

DrawOptions unshadowed() {
    DrawOptions options;
    options.shadow = glsl::shadow_none;
    return options;
}

SceneErrors errors_on(const Ground& ground, const Technique& t, int threads) {
    const Stage stage = stage_for(View{.id = "docs", .elevation_deg = measured_elevation_deg});
    const Frame frame = cpu_trace(ground.rays, ground.baked.maps, ground.baked.height_scale, ground.baked.zero_level, stage.lighting, t,
                                  default_params(t), unshadowed(), threads);
    const Vec2i texels{ground.baked.maps.height.width(), ground.baked.maps.height.height()};
    const HitMetrics m = hit_metrics(frame, ground.truth, ground.rays, texels, threads);
    return {*m.missed_first_hit, *m.early_hit, m.uv_error_texels->p99, m.fetches->mean, telling_rays(frame, ground.truth, ground.rays, texels)};
}

// One ray of that picture, step by step, and the command that draws the same.
std::string ray_figure(const Ground& ground, const Technique& t, Vec2i pixel) {
    const float* view = ground.rays.view.at(pixel.x, pixel.y);
    const float* uv = ground.rays.uv.at(pixel.x, pixel.y);
    const RayQuestion question{.uv = {uv[0], uv[1]},
                               .view = normalize(Vec3d{view[0], view[1], view[2]}),
                               .height_scale = ground.baked.height_scale,
                               .zero_level = ground.baked.zero_level,
                               .lod = ground.rays.lod(pixel.x, pixel.y)};
    const float* hit = ground.truth.hit_uv.at(pixel.x, pixel.y);
    const Section section = section_of(ground.baked.maps, question, {hit[0], hit[1]}, ground.truth.hit_height(pixel.x, pixel.y));
    const Search search = search_along(section, t, default_params(t), ground.baked.maps);
    return svg_text(search_figure(section, {&search, 1}, ground.baked.maps.height,
                                  {.heading = std::string(ground.scene->title),
                                   .where = "Pixel " + std::to_string(pixel.x) + "," + std::to_string(pixel.y) + " of " + std::to_string(measured_width) + " x " +
                                            std::to_string(measured_height) + ", seen " + number(measured_elevation_deg) + " degrees above the plane."}),
                    Paper::either);
}

std::string ray_command(const Technique& t, const Scene& scene, Vec2i pixel) {
    return "relievo explain --material " + std::string(scene.id) + " --texels " + std::to_string(measured_texels) + " --technique " + std::string(t.id) + " --view " +
           number(measured_elevation_deg) + " --size " + std::to_string(measured_width) + "x" + std::to_string(measured_height) + " --pixel " + std::to_string(pixel.x) + "," +
           std::to_string(pixel.y) + " --out ray.svg";
}

std::string chapter(const Technique& t, const std::vector<std::pair<std::string, SceneErrors>>& measured, const Scene& shown, const TellingRays& rays) {
    const std::string_view text = heightfield::text(t.id);
    const auto ray = [&](const char* which, const char* words, Vec2i pixel) {
        return "![" + std::string(words) + "](../figures/" + std::string(t.id) + which + ".svg)\n\n<!-- measured -->\n*" + words + ": `" + ray_command(t, shown, pixel) +
               "`*\n<!-- /measured -->\n";
    };
    std::ostringstream out;
    out << "# " << t.title << "\n\n*" << t.source.author << ", \"" << t.source.title << "\", " << t.source.year << ".*\n\n"
        << "It " << t.summary << ".\n\n"
        << "![" << t.title << ", the exact reference, and where they differ](../figures/" << t.id << ".png)\n\n"
        << "*" << shown.title << " seen " << number(figure_elevation_deg) << " degrees above the plane. Left: " << t.id
        << " at its default knobs. Middle: the exact reference. Right: where the hit is wrong; orange is late (behind the true surface), blue early, "
           "brighter is farther, on a logarithmic scale from half a texel to 64 texels. Made by `relievo docs`.*\n\n"
        << "## How it works\n\n"
        << opening_comment(text) << "\n"
        << ray("-ray", "A ray it follows well, step by step", rays.typical) << "\n```glsl\n"
        << code_of(text) << "```\n\nThe whole of [`" << t.id << ".glsl`](../../../shaders/techniques/heightfield/" << t.id
        << ".glsl); `uv_at` and the ray are explained in [Conventions](../../concepts/conventions.md#the-ray).\n\n"
        << "## What it needs and shows\n\n"
        << "| | |\n|---|---|\n"
        << "| maps of the search | " << map_names(t) << " |\n"
        << "| shaded by | " << title_of(t.shaded_by) << " |\n"
        << "| effects | " << effect_names(t.effects) << " |\n"
        << "| fetches, at most | " << t.max_fetches(default_params(t)) << " at the defaults |\n";
    for (const KnobDefault& k : t.knobs)
        out << "| `" << k.knob->id << "` = " << number(k.value, 4) << " | " << k.knob->help << " (" << number(k.knob->min, 4) << " to "
            << number(k.knob->max, 4) << (k.knob->unit.empty() ? "" : " ") << k.knob->unit << ") |\n";
    out << "\n## How right it is\n\n"
        << "It promises: " << promise_text(t) << " ([What is promised](../../concepts/promises.md); the contract and every comparison check it.)\n\n"
        << "Procedural materials of " << measured_texels << "^2 texels seen " << number(measured_elevation_deg) << " degrees above the plane, "
        << measured_width << " x " << measured_height << " rays of the CPU run of the listing above, against the exact first hit:\n\n"
        << "<!-- measured -->\n| scene | missed first hits | early hits | UV error, 99th percentile (texels) | fetches, mean |\n|---|---|---|---|---|\n";
    for (const auto& [scene, e] : measured)
        out << "| " << scene << " | " << share_text(e.missed) << " | " << share_text(e.early) << " | " << number(e.p99) << " | " << number(e.fetches, 3) << " |\n";
    out << "<!-- /measured -->\n\n## Where it fails\n\n" << static_cast<char>(std::toupper(t.limits[0])) << t.limits.substr(1) << ".\n\n"
        << ray("-hard-ray", "A ray that is hard for it", rays.hard);
    return out.str();
}

std::string techniques_page() {
    std::ostringstream out;
    out << "# Techniques, in order of year\n\n| year | technique | it ... | maps | effects | where it fails |\n|---|---|---|---|---|---|\n";
    for (const Technique& t : techniques())
        out << "| " << t.source.year << " | [" << t.title << "](techniques/" << t.id << ".md) | " << t.summary << " | " << map_names(t) << " | "
            << effect_names(t.effects) << " | " << t.limits << " |\n";
    out << "\n## Fur\n\nLayers of hair are a family of their own (`relievo fur --mode`): they are not asked for a first hit but for how much of a pixel they cover.\n\n"
           "| year | mode | it ... | where it fails |\n|---|---|---|---|\n";
    for (const FurMode& m : fur_modes) out << "| " << m.year << " | [" << m.title << "](fur/" << m.id << ".md) (`" << m.id << "`) | " << m.summary << " | " << m.limits << " |\n";
    out << "\n[The table of effects](effects.md) says how much of each effect was measured.\n";
    return out.str();
}

std::string effects_page(int threads) {
    std::ostringstream out;
    out << "# The four effects, measured\n\nEach effect is looked for in a scene in which it can only be there or not. The number is a share: 1 is the whole effect, 0 none of it. "
           "The contract tests hold every technique to its claim with the same scenes and thresholds ([`src/effects`](../../src/effects/effects.cpp)).\n\n"
        << "| effect | scene | number | there from | absent up to |\n|---|---|---|---|---|\n";
    for (const EffectKind& k : effect_kinds())
        out << "| " << k.title << " | " << k.scene << " | " << k.number << " | " << number(k.present_from) << " | " << number(k.absent_to) << " |\n";
    std::vector<const Technique*> all;
    for (const Technique& t : techniques()) all.push_back(&t);
    out << "\n## Every technique\n\nMade by `relievo effects`, beside the table published by Nobrega de Lima (2011, table 4.1). That table was drawn up from the papers; where it is not "
           "mentioned, it agrees or has no such row.\n\n<!-- measured -->\n"
        << effects_text(effects_table(all, threads), true) << "<!-- /measured -->\n";
    return out.str();
}

std::string tables_page() {
    std::ostringstream out;
    out << "# Maps, knobs, modifiers, scenes and views\n\n## Maps\n\n| id | what it holds | format | source |\n|---|---|---|---|\n";
    for (const MapKind& m : map_kinds()) out << "| `" << m.id << "` | " << m.summary << " | " << m.format << " | " << m.source << " |\n";
    out << "\n## Knobs\n\n| id | meaning | range | unit |\n|---|---|---|---|\n";
    for (const Knob* k : knobs)
        out << "| `" << k->id << "` | " << k->help << " | " << number(k->min, 4) << " to " << number(k->max, 4) << " | " << k->unit << " |\n";
    out << "\n## Modifiers\n\nThey work with every technique. What a number is for stands in the last column.\n\n| modifier | value | what it does | source |\n|---|---|---|---|\n";
    for (const Modifier& m : modifiers())
        for (const ModifierValue& v : m.values) {
            out << "| `" << m.id << "` | `" << v.id << "` | " << v.help << " | ";
            if (!v.source.author.empty()) out << v.source.author << ' ' << v.source.year;
            out << " |\n";
        }
    out << "\n| number | meaning | range | unit | with |\n|---|---|---|---|---|\n";
    for (const ModifierNumber& n : modifier_numbers()) {
        out << "| `" << n.id << "` | " << n.help << " | " << number(n.min, 4) << " to " << number(n.max, 4) << " | " << n.unit << " | ";
        std::string with;
        for (std::size_t i = 0; i < n.of->values.size(); ++i)
            if ((n.values >> i & 1u) != 0) with += (with.empty() ? "" : ", ") + std::string(n.of->values[i].id);
        out << n.of->id << ": " << with << " |\n";
    }
    out << "\n## Scenes\n\n| id | what it is there to show | height_scale |\n|---|---|---|\n";
    for (const Scene& s : scenes()) out << "| `" << s.id << "` | " << s.summary << " | " << number(s.height_scale) << " |\n";
    out << "\n## Views\n\n| id | degrees above the plane |\n|---|---|\n";
    for (const View& v : views()) out << "| `" << v.id << "` | " << number(v.elevation_deg) << " |\n";
    return out.str();
}

// Draws a technique on a scene on the GPU, with the reference and the error picture.
class Figures {
public:
    Figures(const std::string& device, int threads) : gpu_(device, false), threads_(threads) {
        settings_.width = panel_width;
        settings_.height = panel_height;
        settings_.offsets = sample_offsets(9);
    }

    struct Panels {
        Image8 picture, reference, error;
    };

    Panels draw(const Technique& t, const Scene& scene) {
        const Shown& shown = scene_of(scene);
        const Frame frame = gpu_.draw(shown.stage, *shown.material, t, default_params(t), settings_);
        const HeightField& field = shown.baked.maps.height;
        const ImageF error = hit_error_texels(frame, shown.truth, shown.rays.front(), {field.width(), field.height()}, threads_);
        return {srgb_picture(frame.colour), srgb_picture(shown.truth.colour), hit_error_picture(error, threads_)};
    }

private:
    struct Shown {
        Stage stage;
        BakedMaps baked;
        std::shared_ptr<const GpuMaterial> material;
        std::vector<RayField> rays;
        Frame truth;
    };

    const Shown& scene_of(const Scene& scene) {
        const auto found = shown_.find(std::string(scene.id));
        if (found != shown_.end()) return found->second;
        Shown s;
        s.stage = stage_for(View{.id = "figure", .elevation_deg = figure_elevation_deg});
        s.baked = bake_maps(load_source({.folder = std::string(scene.id), .procedural_size = figure_texels, .threads = threads_}),
                            maps_of_all(), {.threads = threads_});
        s.material = gpu_.upload(s.baked.maps, s.baked.height_scale, s.baked.zero_level);
        for (const Vec2f o : settings_.offsets) s.rays.push_back(gpu_.rays(s.stage, *s.material, panel_width, panel_height, o));
        s.truth = reference_picture(s.stage, s.baked.maps, s.rays,
                                    {.height_scale = s.baked.height_scale, .zero_level = s.baked.zero_level, .threads = threads_});
        return shown_.emplace(std::string(scene.id), std::move(s)).first->second;
    }

    GpuRenderer gpu_;
    int threads_;
    PictureSettings settings_;
    std::map<std::string, Shown> shown_;
};

}  // namespace

void write_docs(const DocsSettings& settings, const Progress& progress) {
    const fs::path out = settings.out;
    for (const char* part : {"techniques", "fur", "figures"}) {
        if (!settings.figures && std::string_view(part) == "figures") continue;
        std::error_code failed;
        fs::create_directories(out / part, failed);
        if (failed) throw Error("make folder", (out / part).string(), failed.message());
    }

    std::vector<Ground> grounds;
    const std::string stage = "writing the documentation";
    const double units = static_cast<double>(scenes().size() + techniques().size());
    double done = 0;
    for (const Scene& scene : scenes()) {
        grounds.push_back(make_ground(scene, measured_texels, measured_width, measured_height, measured_elevation_deg, settings.threads));
        report(progress, stage, ++done / units);
    }

    std::unique_ptr<Figures> figures;
    if (settings.figures) figures = std::make_unique<Figures>(settings.device, settings.threads);
    for (const Technique& t : techniques()) {
        std::vector<std::pair<std::string, SceneErrors>> measured;
        for (const Ground& ground : grounds) measured.emplace_back(ground.scene->id, errors_on(ground, t, settings.threads));
        // The figure shows the technique's weakness: the scene where most is missed, and cobbles where nothing is.
        std::size_t chosen = 0;
        for (std::size_t i = 0; i < grounds.size(); ++i)
            if (grounds[i].scene->id == "cobbles") chosen = i;
        double worst = 1e-3;
        for (std::size_t i = 0; i < grounds.size(); ++i)
            if (measured[i].second.missed > worst) {
                worst = measured[i].second.missed;
                chosen = i;
            }
        const Scene* shown = grounds[chosen].scene;
        const TellingRays& rays = measured[chosen].second.rays;
        write_file_atomically(out / "techniques" / (std::string(t.id) + ".md"), chapter(t, measured, *shown, rays));
        if (figures) {
            write_file_atomically(out / "figures" / (std::string(t.id) + "-ray.svg"), ray_figure(grounds[chosen], t, rays.typical));
            write_file_atomically(out / "figures" / (std::string(t.id) + "-hard-ray.svg"), ray_figure(grounds[chosen], t, rays.hard));
            const auto panels = figures->draw(t, *shown);
            write_png(out / "figures" / (std::string(t.id) + ".png"), beside({panels.picture, panels.reference, panels.error}), FirstRow::top);
        }
        report(progress, stage, ++done / units);
    }
    write_file_atomically(out / "techniques.md", techniques_page());
    write_file_atomically(out / "tables.md", tables_page());
    const std::string fur = write_fur_chapters({.out = out, .drawn = settings.figures, .device = settings.device, .threads = settings.threads});
    write_file_atomically(out / "effects.md", effects_page(settings.threads) + fur);

    if (figures) {
        write_file_atomically(out / "figures" / "mesh-extrusion.svg", svg_text(extrusion_figure(), Paper::either));
        write_fur_figures(out / "figures", settings.device, settings.threads);
        // Every modifier under all its values, where it shows.
        for (const Modifier& m : modifiers()) {
            VarySettings vary = example_of(m);
            vary.device = settings.device;
            vary.threads = settings.threads;
            vary.sheet = (out / "figures" / ("modifier-" + std::string(m.id) + ".png")).string();
            vary_modifier(vary, {});
        }
        // The front page's picture: from flat to exact, on one material, with the errors under each.
        std::vector<Image8> pictures, errors;
        for (const char* id : {"normal_mapping", "parallax_mapping", "linear_search", "cone_step_mapping", "max_mip_tracing"}) {
            auto panels = figures->draw(*find_technique(id), *find_scene("cobbles"));
            pictures.push_back(std::move(panels.picture));
            errors.push_back(std::move(panels.error));
        }
        write_png(out / "figures" / "readme.png", stacked({beside(pictures), beside(errors)}), FirstRow::top);
    }
}

}  // namespace relievo
