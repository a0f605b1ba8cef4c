#include "report/page.h"

#include "report/escaped.h"
#include "report/measurement_fields.h"
#include "report/page_parts.h"
#include "report/technique_text.h"

#include "core/error.h"
#include "report/css_colour.h"
#include "techniques/catalogue.h"
#include "techniques/knobs.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace relievo {

namespace {

using Json = nlohmann::ordered_json;

// Repeated texts by number, so that a thousand rows do not repeat them.
struct Words {
    std::vector<std::string> list;
    int index(const std::string& word) {
        const auto it = std::ranges::find(list, word);
        if (it != list.end()) return static_cast<int>(it - list.begin());
        list.push_back(word);
        return static_cast<int>(list.size()) - 1;
    }
};

// Five digits: more than any table or plot of the page shows, and half the bytes of a full double.
Json rounded(double value) {
    if (!std::isfinite(value)) return nullptr;
    char text[32];
    std::snprintf(text, sizeof text, "%.5g", value);
    return Json::parse(text);
}

Json technique_json(const Technique& t, const Results& results) {
    Json json{{"id", t.id}, {"title", t.title}, {"summary", t.summary}, {"author", t.source.author}, {"year", t.source.year},
              {"paper", t.source.title}, {"exact", t.exact}, {"limits", t.limits}, {"promise", promise_text(t)}, {"known", true}};
    json["effects"] = {{"motion parallax", t.effects.motion_parallax}, {"self-occlusion", t.effects.self_occlusion},
                       {"self-shadow", t.effects.self_shadow}, {"silhouette", t.effects.silhouette}};
    json["maps"] = Json::array();
    for (const Map map : t.maps) {
        const auto name = std::ranges::find(results.maps, map, &MapName::map);
        if (name != results.maps.end()) json["maps"].push_back({{"title", name->title}, {"summary", name->summary}});
    }
    json["knobs"] = Json::array();
    for (const KnobDefault& d : t.knobs)
        json["knobs"].push_back({{"id", d.knob->id}, {"title", d.knob->title}, {"unit", d.knob->unit}, {"help", d.knob->help}, {"value", rounded(d.value)}});
    return json;
}

struct PageData {
    const Results& results;
    Words techniques, materials, views, reasons, settings;

    explicit PageData(const Results& r) : results(r) {
        // The catalogue's order is that of the years; only what was run is shown, and what the catalogue does not know comes last.
        const auto was_run = [&](std::string_view id) { return std::ranges::find(r.rows, id, &Row::technique) != r.rows.end(); };
        for (const Technique& t : relievo::techniques())
            if (was_run(t.id)) techniques.index(std::string(t.id));
        for (const MaterialNote& m : r.manifest.materials) materials.index(m.name);
    }

    Json row(const Row& r, bool with_pictures) {
        Json json{{"t", techniques.index(r.technique)}, {"m", materials.index(r.material)}, {"v", views.index(r.view)},
                  {"e", rounded(r.elevation_deg)}};
        json["k"] = Json::object();
        for (const auto& [id, value] : r.knobs) json["k"][id] = rounded(value);
        json["s"] = settings.index(setting_text(r.knobs));
        Json numbers = Json::array();
        numbers.push_back(r.m.missed_first_hit && r.m.early_hit ? rounded(*r.m.missed_first_hit + *r.m.early_hit) : Json(nullptr));
        Json missing = Json::object();
        each_field(r.m, [&](const std::string& name, const auto& measured) {
            std::decay_t<decltype(*measured)> value{};
            if (measured) value = *measured;
            else missing[name] = reasons.index(measured.reason);
            each_part(value, [&](const std::string& part, double v) {
                const std::string id = part.empty() ? name : name + "." + part;
                if (std::ranges::find(columns, id, &Column::id) != std::end(columns)) numbers.push_back(measured ? rounded(v) : Json(nullptr));
            });
        });
        json["n"] = numbers;
        if (!missing.empty()) json["r"] = missing;
        if (with_pictures) {
            json["p"] = {r.image, r.error_image, r.fetches_image, r.reference_image};
            if (!r.no_picture.empty()) json["x"] = reasons.index(r.no_picture);
            if (!r.pixels.empty()) json["px"] = {r.pixels, r.reference_pixels};
            if (!r.where.empty()) json["w"] = r.where;
        }
        return json;
    }

    Json all() {
        Json json;
        const Manifest& m = results.manifest;
        json["size"] = {m.width, m.height};
        json["docs"] = m.docs;
        json["columns"] = Json::array();
        for (const Column& c : columns)
            json["columns"].push_back({{"id", c.id}, {"title", c.title}, {"unit", c.unit}, {"small", c.smaller_is_better}, {"help", c.help}});
        json["rows"] = Json::array();
        for (const Row& r : results.rows) json["rows"].push_back(row(r, true));
        json["sweep"] = Json::array();
        for (const Row& r : results.sweep) json["sweep"].push_back(row(r, false));
        json["techniques"] = Json::array();
        for (const std::string& id : techniques.list) {
            const Technique* t = find_technique(id);
            json["techniques"].push_back(t ? technique_json(*t, results) : Json{{"id", id}, {"title", readable_name(id)}, {"known", false}});
        }
        json["materials"] = Json::array();
        for (const std::string& name : materials.list) {
            Json material{{"id", name}, {"title", readable_name(name)}};
            const auto it = std::ranges::find(m.materials, name, &MaterialNote::name);
            if (it != m.materials.end()) {
                material.update(Json{{"width", it->width}, {"height", it->height}, {"scale", rounded(it->height_scale)}, {"zero", rounded(it->zero_level)},
                                     {"size_m", it->physical_size_m ? rounded(*it->physical_size_m) : Json(nullptr)}, {"notes", it->notes},
                                     {"hash", it->input_hash}});
            }
            json["materials"].push_back(material);
        }
        json["views"] = views.list;
        json["reasons"] = reasons.list;
        json["settings"] = settings.list;
        const auto legend = [](const Legend& l) {
            Json stops = Json::array();
            for (const LegendStop& s : l.stops) stops.push_back({rounded(s.position), css_colour(s.colour), s.label});
            Json keys = Json::array();
            for (const LegendKey& k : l.keys) keys.push_back({css_colour(k.colour), k.label});
            return Json{{"title", l.title}, {"unit", l.unit}, {"low", l.low_end}, {"high", l.high_end}, {"stops", stops}, {"keys", keys}};
        };
        json["legends"] = {{"error", legend(results.error_legend)}, {"fetches", legend(results.fetches_legend)}};
        return json;
    }
};

// Inside a script element a text must not spell the end of the element, nor open a comment.
std::string script_text(std::string json) {
    for (std::size_t at = 0; (at = json.find('<', at)) != std::string::npos; at += 6) json.replace(at, 1, "\\u003c");
    return json;
}

std::string conditions(const Manifest& m) {
    std::string list;
    const auto item = [&](const char* term, const std::string& text) {
        if (!text.empty()) list += "<div><dt>" + std::string(term) + "</dt><dd>" + html_text(text) + "</dd></div>\n";
    };
    item("Device", m.device);
    item("Driver", m.driver);
    item("Pictures", std::to_string(m.width) + " × " + std::to_string(m.height) + " pixels");
    item("Timed runs", m.runs > 0 ? std::to_string(m.runs) + ", interleaved" : "none");
    item("Reference", m.samples_per_pixel > 0 ? std::to_string(m.samples_per_pixel) + " samples per pixel, exact hits in double precision" : "");
    item("Self-shadow", m.shadow);
    if (!m.modifiers.empty()) item("Modifiers", m.modifiers);
    item("Threads", std::to_string(m.threads));
    item("Took", m.seconds > 0 ? short_number(m.seconds) + " s" : "");
    item("Date", m.date);
    item("relievo", m.version);
    return list;
}

// The conditions in one line, under the answer.
std::string ran(const Manifest& m) {
    std::string text;
    for (const std::string& part : {m.device, m.driver, std::to_string(m.width) + " × " + std::to_string(m.height) + " pixels", m.date.substr(0, 10)})
        if (!part.empty()) text += (text.empty() ? "" : " · ") + html_text(part);
    return text;
}

}  // namespace

std::string page_html(const Results& results) {
    if (results.rows.empty()) throw Error("write the report", "index.html", "there is no row to show", "compare at least one technique on one material");

    std::string script;
    for (const auto& [name, text] : page_parts())
        if (name.ends_with(".js")) script += text + "\n";
    std::string sentences;
    for (const std::string& sentence : answer(results)) sentences += html_text(sentence) + "\n";

    const std::string& frame = page_parts().at("index.html");
    const auto part = [&](const std::string& name) -> std::string {
        if (name == "style") return page_parts().at("style.css");
        if (name == "script") return script;
        if (name == "data") return script_text(PageData(results).all().dump(-1, ' ', false, Json::error_handler_t::replace));
        if (name == "answer") return sentences;
        if (name == "conditions") return conditions(results.manifest);
        if (name == "ran") return ran(results.manifest);
        if (name == "command") return html_text(results.manifest.command);
        throw Error("write the report", "index.html", "its frame asks for an unknown part \"" + name + "\"");
    };
    // One pass, so that nothing inside the results is ever taken for a mark of the frame.
    std::string html;
    std::size_t at = 0;
    for (std::size_t mark; (mark = frame.find("@{", at)) != std::string::npos;) {
        const std::size_t end = frame.find('}', mark);
        html.append(frame, at, mark - at);
        html += part(frame.substr(mark + 2, end - mark - 2));
        at = end + 1;
    }
    html.append(frame, at);
    return html;
}

}  // namespace relievo
