#include "report/measurement_fields.h"
#include "report/results.h"

#include "core/error.h"
#include "report/css_colour.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <iterator>

namespace relievo {

namespace {

using Json = nlohmann::ordered_json;

// --- writing -------------------------------------------------------------------------------------------------------------

// Bytes that are no UTF-8 (a folder's name on disk may hold any) are replaced, so that a result is never lost to its name.
std::string text_of(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

template <class T>
bool all_finite(T value) {
    bool finite = true;
    each_part(value, [&](const char*, double v) { finite = finite && std::isfinite(v); });
    return finite;
}

template <class T>
Json value_of(T value) {
    Json json = Json::object();
    each_part(value, [&](const std::string& part, double v) {
        if (part.empty()) json = v;
        else json[part] = v;
    });
    if constexpr (std::is_same_v<T, TimeSpread>) json["runs"] = value.runs;
    return json;
}

void put_measurement(Json& row, Json& reasons, const Measurement& m) {
    each_field(m, [&](const char* name, const auto& measured) {
        if (measured && all_finite(*measured)) {
            row[name] = value_of(*measured);
            return;
        }
        row[name] = nullptr;
        if (measured) reasons[name] = "the computed value is not a finite number";
        else reasons[name] = measured.reason.empty() ? "not measured" : measured.reason;
    });
}

Json row_json(const Row& r, bool with_pictures) {
    Json row{{"technique", r.technique}, {"material", r.material}, {"view", r.view}, {"elevation_deg", r.elevation_deg}};
    Json reasons = Json::object();
    row["knobs"] = Json::object();
    for (const auto& [id, value] : r.knobs) row["knobs"][id] = value;
    put_measurement(row, reasons, r.m);
    const Measured<bool> inside = inside_budget(r.m);
    row["inside_budget"] = inside ? Json(*inside) : Json(nullptr);
    if (!inside) reasons["inside_budget"] = inside.reason;
    if (with_pictures) {
        const auto picture = [&](const char* name, const std::string& path) {
            row[name] = path.empty() ? Json(nullptr) : Json(path);
            if (path.empty()) reasons[name] = r.no_picture.empty() ? "this picture was not made" : r.no_picture;
        };
        picture("image", r.image);
        picture("error_image", r.error_image);
        picture("reference_image", r.reference_image);
        picture("fetches_image", r.fetches_image);
        if (!r.pixels.empty()) row["pixels"] = r.pixels;
        if (!r.reference_pixels.empty()) row["reference_pixels"] = r.reference_pixels;
        if (!r.where.empty()) row["where"] = r.where;
    }
    if (!reasons.empty()) row["reasons"] = reasons;
    return row;
}

Json manifest_json(const Manifest& m) {
    Json json{{"program", "relievo"}, {"version", m.version}, {"command", m.command}, {"date", m.date},
              {"device", m.device}, {"driver", m.driver}, {"width", m.width}, {"height", m.height}, {"runs", m.runs},
              {"samples_per_pixel", m.samples_per_pixel}, {"shadow", m.shadow}, {"modifiers", m.modifiers}, {"threads", m.threads}, {"seconds", m.seconds},
              {"docs", m.docs}};
    json["materials"] = Json::array();
    for (const MaterialNote& n : m.materials) {
        json["materials"].push_back({{"name", n.name}, {"width", n.width}, {"height", n.height}, {"height_scale", n.height_scale},
                                     {"zero_level", n.zero_level},
                                     {"physical_size_m", n.physical_size_m ? Json(*n.physical_size_m) : Json(nullptr)},
                                     {"notes", n.notes}, {"input_hash", n.input_hash}});
    }
    return json;
}

Json legend_json(const Legend& legend) {
    Json json{{"title", legend.title}, {"unit", legend.unit}, {"low_end", legend.low_end}, {"high_end", legend.high_end},
              {"stops", Json::array()}, {"keys", Json::array()}};
    for (const LegendStop& s : legend.stops)
        json["stops"].push_back({{"position", s.position}, {"value", s.value}, {"colour", css_colour(s.colour)}, {"label", s.label}});
    for (const LegendKey& k : legend.keys) json["keys"].push_back({{"colour", css_colour(k.colour)}, {"label", k.label}});
    return json;
}

// --- reading -------------------------------------------------------------------------------------------------------------

// A value with the path that leads to it, so that an error can say where.
struct Node {
    const Json& json;
    const std::string& source;
    std::string path;

    [[noreturn]] void fail(const std::string& reason) const {
        throw Error("read results", source, (path.empty() ? "" : path + ": ") + reason,
                    "expected a results.json written by relievo compare");
    }
    bool has(const char* key) const { return json.is_object() && json.contains(key); }
    Node at(const char* key) const {
        if (!json.is_object()) fail(std::string("expected an object, found ") + json.type_name());
        if (!json.contains(key)) fail(std::string("\"") + key + "\" is missing");
        return {json.at(key), source, path.empty() ? key : path + "." + key};
    }
    Node at(std::size_t i) const { return {json.at(i), source, path + "[" + std::to_string(i) + "]"}; }
    std::size_t size() const {
        if (!json.is_array()) fail(std::string("expected a list, found ") + json.type_name());
        return json.size();
    }
    std::string text() const {
        if (!json.is_string()) fail(std::string("expected a text, found ") + json.type_name());
        return json.get<std::string>();
    }
    double number() const {
        if (!json.is_number()) fail(std::string("expected a number, found ") + json.type_name());
        const double v = json.get<double>();
        if (!std::isfinite(v)) fail("the number is not finite");
        return v;
    }
    int whole() const {
        const double v = number();
        if (v != std::floor(v) || std::abs(v) > 2e9) fail("expected a whole number");
        return static_cast<int>(v);
    }
};

template <class F>
auto list_of(const Node& node, F each) {
    std::vector<decltype(each(node))> list;
    const std::size_t count = node.size();
    list.reserve(count);
    for (std::size_t i = 0; i < count; ++i) list.push_back(each(node.at(i)));
    return list;
}

std::string reason_for(const Node& row, const char* name) {
    if (row.has("reasons") && row.at("reasons").has(name)) return row.at("reasons").at(name).text();
    return "not recorded";
}

Row read_row(const Node& node) {
    Row r;
    r.technique = node.at("technique").text();
    r.material = node.at("material").text();
    r.view = node.at("view").text();
    r.elevation_deg = node.at("elevation_deg").number();
    const Node knobs = node.at("knobs");
    if (!knobs.json.is_object()) knobs.fail(std::string("expected an object, found ") + knobs.json.type_name());
    for (const auto& [id, value] : knobs.json.items()) r.knobs.emplace_back(id, Node{value, node.source, knobs.path + "." + id}.number());
    each_field(r.m, [&](const char* name, auto& measured) {
        using T = std::decay_t<decltype(*measured)>;
        if (!node.has(name) && std::string_view(name).starts_with("astray")) {  // absent from older files
            measured = Measured<T>::missing("not recorded");
            return;
        }
        const Node field = node.at(name);
        if (field.json.is_null()) {
            measured = Measured<T>::missing(reason_for(node, name));
            return;
        }
        T value{};
        each_part(value, [&](const std::string& part, double& v) { v = part.empty() ? field.number() : field.at(part.c_str()).number(); });
        if constexpr (std::is_same_v<T, TimeSpread>) value.runs = field.has("runs") ? field.at("runs").whole() : 0;
        measured = value;
    });
    const auto picture = [&](const char* name, std::string& path) {
        if (!node.has(name)) return;
        const Node field = node.at(name);
        if (field.json.is_null()) r.no_picture = reason_for(node, name);
        else path = field.text();
    };
    picture("image", r.image);
    picture("error_image", r.error_image);
    picture("reference_image", r.reference_image);
    picture("fetches_image", r.fetches_image);
    if (node.has("pixels")) r.pixels = node.at("pixels").text();
    if (node.has("reference_pixels")) r.reference_pixels = node.at("reference_pixels").text();
    if (node.has("where")) r.where = node.at("where").text();
    return r;
}

Manifest read_manifest(const Node& node) {
    Manifest m;
    m.command = node.at("command").text();
    m.version = node.at("version").text();
    m.date = node.at("date").text();
    m.device = node.at("device").text();
    m.driver = node.at("driver").text();
    m.width = node.at("width").whole();
    m.height = node.at("height").whole();
    m.runs = node.at("runs").whole();
    m.samples_per_pixel = node.at("samples_per_pixel").whole();
    m.shadow = node.at("shadow").text();
    if (node.has("modifiers")) m.modifiers = node.at("modifiers").text();  // absent before 0.2
    m.threads = node.at("threads").whole();
    m.seconds = node.at("seconds").number();
    if (node.has("docs")) m.docs = node.at("docs").text();
    m.materials = list_of(node.at("materials"), [](const Node& n) {
        MaterialNote note;
        note.name = n.at("name").text();
        note.width = n.at("width").whole();
        note.height = n.at("height").whole();
        note.height_scale = n.at("height_scale").number();
        note.zero_level = n.at("zero_level").number();
        if (n.has("physical_size_m") && !n.at("physical_size_m").json.is_null()) note.physical_size_m = n.at("physical_size_m").number();
        note.notes = list_of(n.at("notes"), [](const Node& s) { return s.text(); });
        note.input_hash = n.at("input_hash").text();
        return note;
    });
    return m;
}

Rgb8 read_colour(const Node& node) {
    const std::string text = node.text();
    unsigned r = 0, g = 0, b = 0;
    if (text.size() != 7 || std::sscanf(text.c_str(), "#%2x%2x%2x", &r, &g, &b) != 3) node.fail("is not a colour like #rrggbb");
    return {static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(b)};
}

Legend read_legend(const Node& node) {
    Legend legend{node.at("title").text(), node.at("unit").text(), node.at("low_end").text(), node.at("high_end").text(), {}, {}};
    legend.stops = list_of(node.at("stops"), [](const Node& s) {
        return LegendStop{s.at("position").number(), s.at("value").number(), read_colour(s.at("colour")), s.at("label").text()};
    });
    legend.keys = list_of(node.at("keys"), [](const Node& k) { return LegendKey{read_colour(k.at("colour")), k.at("label").text()}; });
    return legend;
}

}  // namespace

std::string results_json(const Results& results) {
    Json json{{"manifest", manifest_json(results.manifest)}, {"rows", Json::array()}, {"sweep", Json::array()}};
    for (const Row& r : results.rows) json["rows"].push_back(row_json(r, true));
    for (const Row& r : results.sweep) json["sweep"].push_back(row_json(r, false));
    json["legends"] = {{"error", legend_json(results.error_legend)}, {"fetches", legend_json(results.fetches_legend)}};
    json["maps"] = Json::array();
    for (const MapName& m : results.maps)
        json["maps"].push_back({{"index", static_cast<int>(m.map)}, {"id", m.id}, {"title", m.title}, {"summary", m.summary}});
    return text_of(json);
}

Results parse_results(std::string_view json, const std::string& source) {
    Json parsed;
    try {
        parsed = Json::parse(json);
    } catch (const Json::parse_error& e) {
        throw Error("read results", source, "not JSON, at byte " + std::to_string(e.byte), "was it written to the end?");
    }
    const Node root{parsed, source, ""};
    Results results;
    results.manifest = read_manifest(root.at("manifest"));
    results.rows = list_of(root.at("rows"), read_row);
    if (root.has("sweep")) results.sweep = list_of(root.at("sweep"), read_row);
    if (root.has("legends")) {
        const Node legends = root.at("legends");
        if (legends.has("error")) results.error_legend = read_legend(legends.at("error"));
        if (legends.has("fetches")) results.fetches_legend = read_legend(legends.at("fetches"));
    }
    if (root.has("maps")) {
        results.maps = list_of(root.at("maps"), [](const Node& n) {
            const int index = n.at("index").whole();
            if (index < 0 || index >= map_count) n.fail("no map has index " + std::to_string(index));
            return MapName{static_cast<Map>(index), n.at("id").text(), n.at("title").text(), n.at("summary").text()};
        });
    }
    return results;
}

Results read_results(const std::filesystem::path& path) {
    const std::filesystem::path file = std::filesystem::is_directory(path) ? path / "results.json" : path;
    std::ifstream in(file, std::ios::binary);
    if (!in) throw Error("read results", file.string(), "there is no such file, or it may not be read", "give a results.json or the folder that holds one");
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    return parse_results(text, file.string());
}

}  // namespace relievo
