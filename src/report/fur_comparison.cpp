#include "report/fur_comparison.h"

#include "report/escaped.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <nlohmann/json.hpp>

namespace relievo {

namespace {

using Json = nlohmann::ordered_json;

struct Column {
    std::string_view id;     // in JSON and CSV
    std::string_view title;  // on the page and in the terminal
    int digits;              // behind the point
    double times;            // of the value, as shown to people
    double FurRow::*value;
    std::string_view help;
};
// What a row has beside what it is judged by (fur_measures).
constexpr Column columns[] = {
    {"shared_texel_area", "shared %", 1, 100, &FurRow::shared_texel_area, "share of the surface whose strand also grows at a distant place"},
    {"first_frame_ms", "first ms", 0, 1, &FurRow::first_frame_ms, "from the loaded mesh to the first picture in memory"},
    {"frame_ms", "frame ms", 1, 1, &FurRow::frame_ms, "median of a frame"},
};

double value_of(const FurRow& row, const FurMeasure& m) { return row.errors.*m.value; }
double value_of(const FurRow& row, const Column& c) { return row.*c.value; }

// All numbers of a row in their order: f(FurMeasure or Column).
template <class F>
void for_columns(const F& f) {
    for (const FurMeasure& m : fur_measures) f(m);
    for (const Column& c : columns) f(c);
}

// What the row has more of than its mode's budget, by `name` of the measure, a comma and a space between.
std::string outside_text(const FurRow& row, std::string_view FurMeasure::*name) {
    std::string text;
    for (const FurMeasure& m : fur_measures) {
        if (!is_outside(m, row.errors, row.budget)) continue;
        if (!text.empty()) text += ", ";
        text += m.*name;
    }
    return text;
}

std::string printed(double value, int digits) {
    if (!std::isfinite(value)) return "-";
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}
template <class C>
std::string shown(const FurRow& row, const C& c) {
    return printed(value_of(row, c) * c.times, c.digits);
}

std::string verdict(const FurRow& row) { return inside_budget(row.errors, row.budget) ? "inside" : "outside: " + outside_text(row, &FurMeasure::title); }

// "2 of 8 pictures are outside their mode's budget: cow.obj in fox by shells (FLIP)."; with none "All 8 pictures are inside their mode's budget."
std::string verdict_of_all(const FurComparison& f) {
    std::string which;
    std::size_t outside = 0;
    for (const FurRow& r : f.rows) {
        if (inside_budget(r.errors, r.budget)) continue;
        ++outside;
        if (!which.empty()) which += "; ";
        which += r.mesh + " in " + r.preset + " by " + r.mode + " (" + outside_text(r, &FurMeasure::title) + ")";
    }
    const std::string all = std::to_string(f.rows.size());
    if (outside == 0) return "All " + all + " pictures are inside their mode's budget.";
    return std::to_string(outside) + " of " + all + " pictures are outside their mode's budget: " + which + ".";
}

// The best of each column among rows of one mesh and coat: all of them are better small.
template <class C>
bool best(const std::vector<FurRow>& rows, std::size_t first, std::size_t end, std::size_t at, const C& c) {
    if (end - first < 2 || !std::isfinite(value_of(rows[at], c))) return false;
    for (std::size_t i = first; i < end; ++i)
        if (value_of(rows[i], c) < value_of(rows[at], c)) return false;
    return true;
}

std::size_t end_of_group(const std::vector<FurRow>& rows, std::size_t first) {
    std::size_t end = first;
    while (end < rows.size() && rows[end].mesh == rows[first].mesh && rows[end].preset == rows[first].preset) ++end;
    return end;
}

}  // namespace

std::string fur_comparison_json(const FurComparison& f) {
    Json json{{"version", f.version}, {"command", f.command}, {"device", f.device}, {"width", f.width}, {"height", f.height}, {"passes", f.passes}, {"samples", f.samples},
              {"rows", Json::array()}, {"refused", f.refused}};
    for (const FurRow& r : f.rows) {
        Json row{{"mesh", r.mesh}, {"preset", r.preset}, {"mode", r.mode}, {"faces", r.faces}, {"strands", r.strands}, {"layers", r.layers}};
        const auto number = [](double v) { return std::isfinite(v) ? Json(v) : Json(); };
        for_columns([&](const auto& c) { row[std::string(c.id)] = number(value_of(r, c)); });
        for (const FurMeasure& m : fur_measures) row["budget"][std::string(m.id)] = number(r.budget.*m.value);
        row["inside_budget"] = inside_budget(r.errors, r.budget);
        row["outside"] = Json::array();
        for (const FurMeasure& m : fur_measures)
            if (is_outside(m, r.errors, r.budget)) row["outside"].push_back(m.id);
        row["picture"] = r.picture;
        row["reference"] = r.reference;
        json["rows"].push_back(std::move(row));
    }
    return json.dump(1) + "\n";
}

std::string fur_comparison_csv(const FurComparison& f) {
    std::string text = "mesh,preset,mode,faces,strands,layers";
    for_columns([&](const auto& c) {
        text += ',';
        text += c.id;
    });
    text += ",inside_budget,outside\n";
    for (const FurRow& r : f.rows) {
        text += csv_text(r.mesh) + "," + r.preset + "," + r.mode + "," + std::to_string(r.faces) + "," + std::to_string(r.strands) + "," + std::to_string(r.layers);
        for_columns([&](const auto& c) {
            text += ',';
            if (std::isfinite(value_of(r, c))) text += printed(value_of(r, c), 6);
        });
        text += inside_budget(r.errors, r.budget) ? ",true," : ",false,";
        text += csv_text(outside_text(r, &FurMeasure::id)) + "\n";
    }
    return text;
}

std::string fur_comparison_text(const FurComparison& f) {
    std::vector<std::vector<std::string>> cells{{"mesh", "preset", "mode", "strands", "layers"}};
    for_columns([&](const auto& c) { cells[0].emplace_back(c.title); });
    cells[0].emplace_back("budget");
    for (const FurRow& r : f.rows) {
        auto& line = cells.emplace_back(std::vector<std::string>{r.mesh, r.preset, r.mode, std::to_string(r.strands), std::to_string(r.layers)});
        for_columns([&](const auto& c) { line.push_back(shown(r, c)); });
        line.push_back(verdict(r));
    }
    std::vector<std::size_t> widths(cells[0].size(), 0);
    for (const auto& line : cells)
        for (std::size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], line[c].size());
    std::string text;
    for (const auto& line : cells) {
        for (std::size_t c = 0; c < line.size(); ++c) {
            const std::string pad(widths[c] - line[c].size(), ' ');
            if (c > 0) text += "  ";
            text += c < 3 ? line[c] + pad : c + 1 == line.size() ? line[c] : pad + line[c];
        }
        text += "\n";
    }
    text += verdict_of_all(f) + "\n";
    for (const std::string& reason : f.refused) text += reason + "\n";
    return text;
}

std::string fur_comparison_page(const FurComparison& f) {
    std::string page =
        "<!DOCTYPE html><html lang=en><meta charset=utf-8><meta name=viewport content=\"width=device-width\"><title>Ways of growing fur</title><style>"
        ":root{color-scheme:light dark}body{font:15px/1.45 system-ui,sans-serif;margin:2rem;max-width:90rem}table{border-collapse:collapse;margin:.5rem 0 1rem}"
        "th,td{padding:.2rem .7rem;text-align:right;border-bottom:1px solid #8885;white-space:nowrap}th:first-child{text-align:left}.best{font-weight:700}"
        ".scroll{overflow-x:auto}.row{display:grid;grid-template-columns:repeat(auto-fill,minmax(20rem,1fr));gap:.6rem;margin-bottom:2.5rem}figure{margin:0}img{width:100%;display:block}"
        "figcaption{font-size:.9em;opacity:.8}</style><h1>Ways of growing fur</h1><p>Each picture is scored against the coat's own strands as curves, ray traced with " +
        std::to_string(f.samples) + " rays a pixel. The light of the textured layers is fitted to it first, as it is not their maps' fault; that of strands is what it is. Drawn at " +
        std::to_string(f.width) + " x " + std::to_string(f.height) + ", " + std::to_string(f.passes) + " passes averaged, by " + html_text(f.device) + ". Bold: the best of the table.</p><ul>";
    for_columns([&](const auto& c) { page += "<li><b>" + std::string(c.title) + "</b>: " + std::string(c.help) + "</li>"; });
    page += "</ul><p>" + html_text(verdict_of_all(f)) + "</p>\n";
    for (std::size_t first = 0; first < f.rows.size();) {
        const std::size_t end = end_of_group(f.rows, first);
        const FurRow& head = f.rows[first];
        page += "<h2>" + html_text(head.mesh) + ", " + html_text(head.preset) + "</h2><div class=scroll><table><thead><tr><th>mode</th><th>faces</th><th>strands</th><th>layers</th>";
        for_columns([&](const auto& c) { page += "<th>" + std::string(c.title) + "</th>"; });
        page += "<th>budget</th></tr></thead><tbody>";
        for (std::size_t i = first; i < end; ++i) {
            const FurRow& r = f.rows[i];
            page += "<tr><th>" + html_text(r.mode) + "</th><td>" + std::to_string(r.faces) + "</td><td>" + std::to_string(r.strands) + "</td><td>" + std::to_string(r.layers) + "</td>";
            for_columns([&](const auto& c) { page += (best(f.rows, first, end, i, c) ? "<td class=best>" : "<td>") + shown(r, c) + "</td>"; });
            page += "<td>" + verdict(r) + "</td></tr>";
        }
        page += "</tbody></table></div><div class=row>";
        for (std::size_t i = first; i < end; ++i) page += "<figure><img loading=lazy src=\"" + html_text(f.rows[i].picture) + "\" alt=\"" + html_text(f.rows[i].mode) + "\"><figcaption>" + html_text(f.rows[i].mode) + "</figcaption></figure>";
        page += "<figure><img loading=lazy src=\"" + html_text(head.reference) + "\" alt=\"traced strands\"><figcaption>traced strands</figcaption></figure></div>\n";
        first = end;
    }
    if (!f.refused.empty()) page += "<h2>No fur grows on</h2><ul>";
    for (const std::string& reason : f.refused) page += "<li>" + html_text(reason) + "</li>";
    if (!f.refused.empty()) page += "</ul>\n";
    return page + "<p>relievo " + html_text(f.version) + ": <code>" + html_text(f.command) + "</code></p></html>\n";
}

}  // namespace relievo
