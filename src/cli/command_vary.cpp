#include "cli/commands.h"

#include "cli/options.h"
#include "cli/progress_display.h"
#include "core/error.h"
#include "core/suggest.h"
#include "pipeline/vary_modifier.h"
#include "scenes/scene.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

namespace relievo {

namespace {

void print_row(const char* material, const char* view, const VariedRow& r, double first_ms) {
    std::printf("%-22s %-8s %-12s %8.4f %8.2f %8.4f %9.3f %6.2f\n", material, view, r.value.c_str(), r.flip, r.psnr_db, r.shadow_error,
                r.gpu_ms, first_ms > 0 ? r.gpu_ms / first_ms : 0);
}

// A line for each picture and value, then for each value the means (of the times the geometric one).
void print_table(const Varied& varied, const Modifier& modifier) {
    std::printf("truth: %s\n%-22s %-8s %-12s %8s %8s %8s %9s %6s\n", varied.truth.empty() ? "nothing modified" : varied.truth.c_str(),
                "material", "view", std::string(modifier.id).c_str(), "FLIP", "PSNR dB", "shadow", "GPU ms", "ratio");
    const std::size_t values = modifier.values.size();
    std::vector<VariedRow> mean(values);
    std::vector<double> log_ms(values);
    for (std::size_t i = 0; i < varied.rows.size(); ++i) {
        const VariedRow& r = varied.rows[i];
        print_row(r.material.c_str(), r.view.c_str(), r, varied.rows[i - i % values].gpu_ms);
        VariedRow& m = mean[i % values];
        const double share = static_cast<double>(values) / static_cast<double>(varied.rows.size());
        m.value = r.value;
        m.flip += share * r.flip;
        m.psnr_db += share * r.psnr_db;
        m.shadow_error += share * r.shadow_error;
        log_ms[i % values] += share * std::log(std::max(r.gpu_ms, 1e-6));
    }
    for (std::size_t i = 0; i < values; ++i) {
        mean[i].gpu_ms = std::exp(log_ms[i]);
        print_row("mean", "all", mean[i], mean[0].gpu_ms);
    }
}

}  // namespace

void add_vary_command(CLI::App& app) {
    struct Options {
        VarySettings settings;
        std::string modifier, technique, size = "448x252";
        std::vector<std::string> materials, views;
        int texels = 512;
        bool quiet = false, json = false;
    };
    auto o = std::make_shared<Options>();
    auto* verb = app.add_subcommand("vary", "Scores every value of one modifier against the truth, with times");
    verb->add_option("modifier", o->modifier, "id (relievo list modifiers)")->required();
    verb->add_option("--material", o->materials, "folder with maps, or a procedural material's id; may be repeated (default: the procedural set)");
    verb->add_option("--technique", o->technique, "id (default: the exact one, so that only the modifier errs)");
    verb->add_option("--view", o->views, "grazing, middle, steep or degrees above the plane, and @2 for twice as far away; may be repeated (default: the three)");
    verb->add_option("--size", o->size, "picture size, WIDTHxHEIGHT")->capture_default_str();
    verb->add_option("--runs", o->settings.runs, "timed runs of each value, interleaved")->check(CLI::Range(1, 10000))->capture_default_str();
    verb->add_option("--samples", o->settings.samples, "samples per pixel of the pictures: 1, 5, 9 or 25")
        ->check(CLI::IsMember({1, 5, 9, 25}))
        ->capture_default_str();
    verb->add_option("--truth-samples", o->settings.truth_samples, "samples per pixel of the truth: 5, 9, 25 or 289; 0: those of the pictures")
        ->check(CLI::IsMember({0, 5, 9, 25, 289}))
        ->capture_default_str();
    verb->add_option("--texels", o->texels, "edge of the procedural materials' maps")->check(CLI::Range(1, 8192))->capture_default_str();
    verb->add_option("--device", o->settings.device, "software, or part of a device's name (relievo list devices)");
    verb->add_option("--threads", o->settings.threads, "threads of the CPU work (0: all cores)")->check(CLI::NonNegativeNumber);
    add_modifier_options(*verb, o->settings.options);
    verb->add_option("--pictures", o->settings.pictures, "folder for the pictures (default: none are kept)");
    verb->add_option("--contact-sheet", o->settings.sheet, "FILE.png: from every view all values on the first material, then the truth, in one picture");
    verb->add_flag("--quiet", o->quiet, "no progress");
    verb->add_flag("--json", o->json, "print JSON instead of a table");
    verb->footer("Examples:\n  relievo vary shadow --material cobbles --light-radius 4\n"
                 "  relievo vary edge --samples 1 --truth-samples 289 --pictures edges");
    verb->callback([o] {
        VarySettings& s = o->settings;
        s.modifier = find_modifier(o->modifier);
        if (s.modifier == nullptr) {
            std::vector<std::string> known;
            for (const Modifier& m : modifiers()) known.emplace_back(m.id);
            throw UsageError(unknown_word("modifier", o->modifier, known));
        }
        if (!o->technique.empty()) s.technique = &parse_technique(o->technique);
        s.views = parse_views(o->views);
        const Size size = parse_size(o->size);
        s.width = size.width;
        s.height = size.height;
        if (o->materials.empty())
            for (const Scene& scene : scenes()) o->materials.emplace_back(scene.id);
        for (const std::string& folder : o->materials)
            s.materials.push_back({.folder = folder, .procedural_size = o->texels, .threads = s.threads});
        const Varied varied = vary_modifier(s, progress_display(o->quiet));
        if (!o->json) {
            print_table(varied, *s.modifier);
            return;
        }
        nlohmann::ordered_json rows = nlohmann::ordered_json::array();
        for (const VariedRow& r : varied.rows)
            rows.push_back({{"material", r.material}, {"view", r.view}, {"value", r.value}, {"flip", r.flip}, {"psnr_db", r.psnr_db},
                            {"shadow_error", r.shadow_error}, {"gpu_ms", r.gpu_ms}});
        std::printf("%s\n", nlohmann::ordered_json{{"modifier", s.modifier->id},
                                                   {"technique", s.technique != nullptr ? s.technique->id : "exact"},
                                                   {"options", described(s.options)},
                                                   {"truth", varied.truth},
                                                   {"device", varied.device},
                                                   {"rows", rows}}
                                .dump(2)
                                .c_str());
    });
}

}  // namespace relievo
