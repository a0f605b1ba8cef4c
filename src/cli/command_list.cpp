#include "cli/commands.h"

#include "report/technique_text.h"
#include "core/error.h"
#include "core/suggest.h"
#include "fur/fur_modes.h"
#include "maps/map_kinds.h"
#include "render/device_bake.h"
#include "render/gpu_renderer.h"
#include "scenes/published_tests.h"
#include "scenes/scene.h"
#include "techniques/catalogue.h"
#include "techniques/modifiers.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

namespace relievo {

namespace {

using Json = nlohmann::ordered_json;

std::string cell(const Json& value);

// What can be listed: a name and its rows as JSON objects, from which the text table is made too.
struct Listing {
    const char* name;
    Json (*rows)();
};

Json technique_rows() {
    Json rows = Json::array();
    for (const Technique& t : techniques()) {
        Json maps = Json::array();
        for (const Map m : t.maps) maps.push_back(map_kinds()[static_cast<std::size_t>(m)].id);
        Json knobs_json = Json::object();
        for (const KnobDefault& k : t.knobs) knobs_json[std::string(k.knob->id)] = k.value;
        rows.push_back({{"id", t.id},
                        {"year", t.source.year},
                        {"title", t.title},
                        {"summary", t.summary},
                        {"author", t.source.author},
                        {"paper", t.source.title},
                        {"maps", maps},
                        {"knobs", knobs_json},
                        {"exact", t.exact},
                        {"promise", promise_text(t)},
                        {"limits", t.limits}});
    }
    return rows;
}

// Fur is a family of its own: what draws layers of hair is not asked for a first hit (docs/architecture.md).
Json fur_rows() {
    Json rows = Json::array();
    for (const FurMode& m : fur_modes)
        rows.push_back({{"id", m.id}, {"year", m.year}, {"title", m.title}, {"summary", m.summary}, {"author", m.author}, {"paper", m.source}, {"limits", m.limits}});
    return rows;
}

Json map_rows() {
    Json rows = Json::array();
    for (const MapKind& m : map_kinds())
        rows.push_back({{"id", m.id}, {"title", m.title}, {"summary", m.summary}, {"format", m.format}, {"source", m.source}, {"on_device", bakes_on_device(m.map)}});
    return rows;
}

Json scene_rows() {
    Json rows = Json::array();
    for (const Scene& s : scenes())
        rows.push_back({{"id", s.id}, {"title", s.title}, {"summary", s.summary}, {"height_scale", s.height_scale}});
    return rows;
}

Json view_rows() {
    Json rows = Json::array();
    for (const View& v : views()) rows.push_back({{"id", v.id}, {"elevation_deg", v.elevation_deg}, {"azimuth_deg", v.azimuth_deg}});
    return rows;
}

Json test_rows() {
    Json rows = Json::array();
    for (const PublishedTest& t : published_tests()) {
        Json runs = Json::object();
        for (const PublishedRun& r : t.runs) {
            std::string settings;
            for (const KnobDefault& k : r.knobs) settings += std::string(settings.empty() ? "" : " ") + std::string(k.knob->id) + "=" + cell(k.value);
            runs[std::string(r.technique)] = settings;
        }
        rows.push_back({{"id", t.id}, {"scene", t.scene}, {"view", t.view}, {"colour_texels", t.colour_texels}, {"height_texels", t.height_texels}, {"settings", runs}});
    }
    return rows;
}

Json knob_rows() {
    Json rows = Json::array();
    for (const Knob* k : knobs)
        rows.push_back({{"id", k->id}, {"title", k->title}, {"min", k->min}, {"max", k->max}, {"step", k->step}, {"unit", k->unit}, {"help", k->help}});
    return rows;
}

Json modifier_rows() {
    Json rows = Json::array();
    for (const Modifier& m : modifiers())
        for (const ModifierValue& v : m.values)
            rows.push_back({{"modifier", m.id}, {"value", v.id}, {"does", v.help},
                            {"source", v.source.author.empty() ? std::string() : std::string(v.source.author) + " " + std::to_string(v.source.year)}});
    return rows;
}

Json device_rows() {
    Json rows = Json::array();
    for (const GpuDevice& d : gpu_devices())
        rows.push_back({{"name", d.name}, {"kind", d.software ? "software" : "GPU"}, {"driver", d.driver}, {"lacks", d.lacks}});
    return rows;
}

constexpr Listing listings[] = {
    {"techniques", technique_rows}, {"fur", fur_rows}, {"maps", map_rows},   {"scenes", scene_rows},
    {"views", view_rows},           {"knobs", knob_rows}, {"modifiers", modifier_rows}, {"tests", test_rows},
    {"devices", device_rows},
};

std::string cell(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_boolean()) return value.get<bool>() ? "yes" : "";
    if (value.is_number_integer()) return std::to_string(value.get<long>());
    if (value.is_number()) {
        char text[32];
        std::snprintf(text, sizeof text, "%g", value.get<double>());
        return text;
    }
    std::string text;
    for (const auto& item : value.items())
        text += (text.empty() ? "" : ", ") + (value.is_object() ? item.key() + "=" + cell(item.value()) : cell(item.value()));
    return text;
}

// Columns as wide as their cells; the columns that hold sentences (over 60 characters) go on lines of their own.
void print_table(const Json& rows) {
    if (rows.empty()) return;
    std::vector<std::string> narrow, wide;
    std::vector<std::size_t> width;
    for (const auto& column : rows[0].items()) {
        std::size_t w = column.key().size();
        for (const Json& row : rows) w = std::max(w, cell(row[column.key()]).size());
        if (w > 44) {
            wide.push_back(column.key());
        } else {
            narrow.push_back(column.key());
            width.push_back(w);
        }
    }
    const auto line = [&](const auto& text_of) {
        std::string text;
        for (std::size_t i = 0; i < narrow.size(); ++i) {
            std::string t = text_of(narrow[i]);
            t.resize(width[i] + 2, ' ');
            text += t;
        }
        while (!text.empty() && text.back() == ' ') text.pop_back();
        std::printf("%s\n", text.c_str());
    };
    line([](const std::string& key) { return key; });
    for (const Json& row : rows) {
        line([&](const std::string& key) { return cell(row[key]); });
        for (const std::string& key : wide) std::printf("    %s: %s\n", key.c_str(), cell(row[key]).c_str());
    }
}

}  // namespace

void add_list_command(CLI::App& app) {
    auto* verb = app.add_subcommand("list", "Shows what there is: techniques, modes of fur, maps, scenes, views, knobs, modifiers, published tests or devices");
    auto what = std::make_shared<std::string>("techniques");
    auto json = std::make_shared<bool>(false);
    verb->add_option("what", *what, "techniques | fur | maps | scenes | views | knobs | modifiers | tests | devices")->capture_default_str();
    verb->add_flag("--json", *json, "print JSON instead of a table");
    verb->footer("Examples:\n  relievo list\n  relievo list devices --json");
    verb->callback([what, json] {
        for (const Listing& listing : listings) {
            if (*what != listing.name) continue;
            const Json rows = listing.rows();
            if (*json) {
                std::printf("%s\n", rows.dump(2).c_str());
            } else {
                print_table(rows);
                if (*what == "techniques") {
                    std::printf("\nFur, drawn by relievo fur --mode:\n");
                    print_table(fur_rows());
                }
            }
            return;
        }
        std::vector<std::string> names;
        for (const Listing& listing : listings) names.emplace_back(listing.name);
        throw UsageError(unknown_word("list", *what, names));
    });
}

}  // namespace relievo
