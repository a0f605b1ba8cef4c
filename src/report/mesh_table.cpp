#include "report/mesh_table.h"

#include "core/error.h"
#include "report/escaped.h"

#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>

namespace relievo {

namespace {

using Json = nlohmann::ordered_json;

// The one list of a row's fields: visit(name, member).
template <class Row, class Visit>
void each_field(Row& row, const Visit& visit) {
    visit("file", row.file);
    visit("input", row.input);
    visit("normals", row.normals);
    visit("index", row.index);
    visit("order", row.order);
    visit("faces", row.faces);
    visit("sphere_radius", row.sphere_radius);
    visit("half_diagonal", row.half_diagonal);
    visit("vertices_before", row.vertices_before);
    visit("vertices_after", row.vertices_after);
    visit("bytes_before", row.bytes_before);
    visit("bytes_after", row.bytes_after);
    visit("load_ms", row.load_ms);
    visit("centre_ms", row.centre_ms);
    visit("normals_ms", row.normals_ms);
    visit("index_ms", row.index_ms);
    visit("order_ms", row.order_ms);
    visit("acmr_fifo16", row.acmr_fifo16);
    visit("acmr_fifo32", row.acmr_fifo32);
    visit("acmr_batched", row.acmr_batched);
    visit("overdraw", row.overdraw);
    visit("frames_per_second", row.frames_per_second);
    visit("vertex_invocations", row.vertex_invocations);
}

template <class T>
Json json_of(const T& value) {
    return value;
}
template <class T>
Json json_of(const std::optional<T>& value) {
    return value ? Json(*value) : Json();
}

template <class T>
void read(const Json& from, T& value) {
    value = from.get<T>();
}
template <class T>
void read(const Json& from, std::optional<T>& value) {
    if (!from.is_null()) value = from.get<T>();
}

std::string printed(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string csv_field(const Json& value) {
    if (value.is_null()) return {};
    if (!value.is_string()) return value.is_number_float() ? printed("%.9g", value.get<double>()) : value.dump();
    return csv_text(value.get<std::string>());
}

std::string seconds(double ms) { return printed("%.4f", ms / 1000); }
std::string kilobytes(std::size_t bytes) { return printed("%.3f", static_cast<double>(bytes) / 1024); }
std::string share_less(double before, double after) { return before > 0 ? printed("%.1f %%", 100 * (1 - after / before)) : ""; }

// The row of a mesh with these options, or none.
const MeshRow* find(const std::vector<const MeshRow*>& rows, std::string_view normals, bool index, std::string_view order) {
    for (const MeshRow* r : rows)
        if (r->normals == normals && r->index == index && r->order == order) return r;
    return nullptr;
}

void cell(std::string& page, const std::string& text, const char* kind = "td") {
    page += std::string("<") + kind + ">" + text + "</" + kind + ">";
}

using Ours = std::function<std::string(const std::vector<const MeshRow*>&)>;
struct PairColumn {
    const char* title;
    Ours ours;
    std::function<std::string(const PublishedMesh&)> theirs;
};

// A column that shows one field of the row with the given options.
Ours from(const char* normals, bool index, const char* order, std::function<std::string(const MeshRow&)> field) {
    return [=](const std::vector<const MeshRow*>& rows) {
        const MeshRow* r = find(rows, normals, index, order);
        return r ? field(*r) : std::string();
    };
}

std::string fps(const MeshRow& r) { return r.frames_per_second ? printed("%.1f", *r.frames_per_second) : ""; }
std::string invocations(const MeshRow& r) { return r.vertex_invocations ? std::to_string(*r.vertex_invocations) : ""; }

std::string optional_seconds(const std::optional<double>& s) { return s ? printed("%.3f", *s) : "not finished"; }
std::string optional_fps(const std::optional<int>& f) { return f ? std::to_string(*f) : "error"; }

void pair_table(std::string& page, const char* title, const std::vector<std::vector<const MeshRow*>>& meshes, const std::vector<PairColumn>& columns) {
    page += std::string("<h2>") + title + "</h2><table><thead><tr><th>mesh</th>";
    for (const PairColumn& c : columns) {
        cell(page, c.title, "th");
        if (c.theirs) cell(page, "2009", "th");
    }
    page += "</tr></thead><tbody>";
    for (const auto& rows : meshes) {
        const PublishedMesh* p = published_mesh(rows.front()->faces);
        page += "<tr><th>" + html_text(rows.front()->file) + (p ? " <i>" + html_text(p->name) + " " + std::to_string(p->level) + "</i>" : std::string()) + "</th>";
        for (const PairColumn& c : columns) {
            cell(page, c.ours(rows));
            if (c.theirs) page += "<td class=old>" + (p ? c.theirs(*p) : std::string()) + "</td>";
        }
        page += "</tr>";
    }
    page += "</tbody></table>\n";
}

}  // namespace

std::string mesh_table_json(const MeshTable& table) {
    Json json{{"version", table.version}, {"date", table.date}, {"device", table.device}, {"threads", table.threads}, {"rows", Json::array()}, {"skipped", table.skipped}};
    for (const MeshRow& row : table.rows) {
        Json line;
        each_field(row, [&](const char* name, const auto& value) { line[name] = json_of(value); });
        json["rows"].push_back(std::move(line));
    }
    return json.dump(1) + "\n";
}

MeshTable parse_mesh_table(std::string_view text, const std::string& source) {
    try {
        const Json json = Json::parse(text);
        MeshTable table{json.at("version"), json.at("date"), json.at("device"), json.at("threads"), {}, json.at("skipped")};
        for (const Json& line : json.at("rows")) each_field(table.rows.emplace_back(), [&](const char* name, auto& value) { read(line.at(name), value); });
        return table;
    } catch (const nlohmann::json::exception& e) {
        throw Error("read", source, e.what(), "it is not a table of meshes; delete it to begin anew");
    }
}

std::string mesh_table_csv(const MeshTable& table) {
    std::string csv;
    const auto put = [&](const std::string& field) { csv += (csv.empty() || csv.back() == '\n' ? "" : ",") + field; };
    const MeshRow names;
    each_field(names, [&](const char* name, const auto&) { put(name); });
    csv += "\r\n";
    for (const MeshRow& row : table.rows) {
        each_field(row, [&](const char*, const auto& value) { put(csv_field(json_of(value))); });
        csv += "\r\n";
    }
    return csv;
}

std::string mesh_table_page(const MeshTable& table) {
    std::vector<std::vector<const MeshRow*>> meshes;  // rows of one file follow each other
    for (const MeshRow& r : table.rows) {
        if (meshes.empty() || meshes.back().front()->file != r.file) meshes.emplace_back();
        meshes.back().push_back(&r);
    }
    std::string page =
        "<!DOCTYPE html><html lang=en><meta charset=utf-8><title>Meshes prepared for drawing</title><style>"
        "body{font:15px/1.45 system-ui,sans-serif;margin:2rem;color:#222}table{border-collapse:collapse;margin:0 0 2rem}"
        "th,td{padding:.2rem .7rem;text-align:right;border-bottom:1px solid #ddd;white-space:nowrap}tbody th{text-align:left;font-weight:500}"
        "thead th{position:sticky;top:0;background:#fff}i{color:#777;font-size:.85em}.old{color:#777}.scroll{overflow-x:auto}</style>"
        "<h1>Meshes prepared for drawing</h1><p>relievo " + html_text(table.version) + ", " + html_text(table.date) + ", " + std::to_string(table.threads) + " threads" +
        (table.device.empty() ? std::string() : ", drawn by " + html_text(table.device)) +
        ". Grey: what the 2009 thesis published of the same mesh, by its number of faces (two cores of 2.1 GHz, GeForce 8600 GT).</p>\n";
    const auto first = [](const std::function<std::string(const MeshRow&)>& field) { return Ours([=](const auto& rows) { return field(*rows.front()); }); };

    pair_table(page, "Table 7.1: the meshes", meshes,
               {{"smallest sphere", first([](const MeshRow& r) { return printed("%.6g", r.sphere_radius); }), {}},
                {"half diagonal", first([](const MeshRow& r) { return printed("%.6g", r.half_diagonal); }), [](const PublishedMesh& p) { return printed("%.6g", p.radius); }},
                {"faces", first([](const MeshRow& r) { return std::to_string(r.faces); }), [](const PublishedMesh& p) { return std::to_string(p.faces); }},
                {"vertices", first([](const MeshRow& r) { return std::to_string(r.faces * 3); }), [](const PublishedMesh& p) { return std::to_string(p.faces * 3); }},
                {"KB", from("distinct", false, "none", [](const MeshRow& r) { return kilobytes(r.bytes_before); }), [](const PublishedMesh& p) { return printed("%.3f", p.kilobytes_before); }}});
    pair_table(page, "Table 7.2: loading, centring and continuous normals, seconds", meshes,
               {{"load", first([](const MeshRow& r) { return seconds(r.load_ms); }), [](const PublishedMesh& p) { return printed("%.3f", p.load_s); }},
                {"centre", from("distinct", true, "meshopt", [](const MeshRow& r) { return seconds(r.centre_ms); }), [](const PublishedMesh& p) { return printed("%.3f", p.centre_s); }},
                {"normals, distinct", from("distinct", true, "meshopt", [](const MeshRow& r) { return seconds(r.normals_ms); }), [](const PublishedMesh& p) { return printed("%.3f", p.normals_s); }},
                {"normals, sum", from("sum", true, "meshopt", [](const MeshRow& r) { return seconds(r.normals_ms); }), {}},
                {"normals, angle", from("angle", true, "meshopt", [](const MeshRow& r) { return seconds(r.normals_ms); }), {}}});
    pair_table(page, "Table 7.3: indexing and order, seconds (the thesis's second column is D3DX, its third Lin and Yu)", meshes,
               {{"index", from("distinct", true, "meshopt", [](const MeshRow& r) { return seconds(r.index_ms); }), [](const PublishedMesh& p) { return printed("%.3f", p.index_s); }},
                {"meshopt", from("distinct", true, "meshopt", [](const MeshRow& r) { return seconds(r.order_ms); }), [](const PublishedMesh& p) { return optional_seconds(p.d3dx_s); }},
                {"fifo", from("distinct", true, "fifo", [](const MeshRow& r) { return seconds(r.order_ms); }), {}},
                {"lin-yu", from("distinct", true, "lin-yu", [](const MeshRow& r) { return seconds(r.order_ms); }), [](const PublishedMesh& p) { return optional_seconds(p.lin_s); }}});
    pair_table(page, "Table 7.4: vertices and KB before and after indexing", meshes,
               {{"vertices before", from("distinct", true, "none", [](const MeshRow& r) { return std::to_string(r.vertices_before); }), [](const PublishedMesh& p) { return std::to_string(p.faces * 3); }},
                {"KB before", from("distinct", true, "none", [](const MeshRow& r) { return kilobytes(r.bytes_before); }), [](const PublishedMesh& p) { return printed("%.3f", p.kilobytes_before); }},
                {"vertices after", from("distinct", true, "none", [](const MeshRow& r) { return std::to_string(r.vertices_after); }), [](const PublishedMesh& p) { return std::to_string(p.vertices_after); }},
                {"KB after", from("distinct", true, "none", [](const MeshRow& r) { return kilobytes(r.bytes_after); }), [](const PublishedMesh& p) { return printed("%.3f", p.kilobytes_after); }},
                {"less by", from("distinct", true, "none", [](const MeshRow& r) { return share_less(static_cast<double>(r.bytes_before), static_cast<double>(r.bytes_after)); }),
                 [](const PublishedMesh& p) { return share_less(p.kilobytes_before, p.kilobytes_after); }}});
    pair_table(page, "Table 7.5: frames a second at 1280x800 under Phong's model", meshes,
               {{"original", from("distinct", false, "none", fps), [](const PublishedMesh& p) { return std::to_string(p.fps_original); }},
                {"indexed", from("distinct", true, "none", fps), [](const PublishedMesh& p) { return std::to_string(p.fps_indexed); }},
                {"meshopt", from("distinct", true, "meshopt", fps), [](const PublishedMesh& p) { return optional_fps(p.fps_d3dx); }},
                {"fifo", from("distinct", true, "fifo", fps), {}},
                {"lin-yu", from("distinct", true, "lin-yu", fps), [](const PublishedMesh& p) { return optional_fps(p.fps_lin); }}});
    pair_table(page, "Vertices computed a frame, by the device's own count", meshes,
               {{"original", from("distinct", false, "none", invocations), {}},
                {"indexed", from("distinct", true, "none", invocations), {}},
                {"meshopt", from("distinct", true, "meshopt", invocations), {}},
                {"fifo", from("distinct", true, "fifo", invocations), {}},
                {"lin-yu", from("distinct", true, "lin-yu", invocations), {}}});

    page += "<h2>All combinations</h2><div class=scroll><table><thead><tr>";
    const MeshRow names;
    each_field(names, [&](const char* name, const auto&) { cell(page, name, "th"); });
    page += "</tr></thead><tbody>";
    for (const MeshRow& row : table.rows) {
        page += "<tr>";
        each_field(row, [&](const char*, const auto& value) {
            const Json json = json_of(value);
            cell(page, json.is_number_float() ? printed("%.4g", json.get<double>()) : html_text(csv_field(json)));
        });
        page += "</tr>\n";
    }
    page += "</tbody></table></div>";
    if (!table.skipped.empty()) {
        page += "<h2>Left out</h2><ul>";
        for (const std::string& s : table.skipped) page += "<li>" + html_text(s) + "</li>";
        page += "</ul>";
    }
    return page + "</html>\n";
}

}  // namespace relievo
