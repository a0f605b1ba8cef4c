#include "report/fur_comparison.h"

#include "report/escaped.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace relievo {

namespace {

using Json = nlohmann::ordered_json;

struct Column {
    const char* id;     // in JSON and CSV
    const char* title;  // on the page and in the terminal
    int digits;         // behind the point
    double times;       // of the value, as shown to people
    double FurRow::*value;
    const char* help;
};
constexpr Column columns[] = {
    {"flip", "FLIP", 4, 1, &FurRow::flip, "mean LDR-FLIP against the traced strands, backdrop included"},
    {"coverage_error", "coverage", 4, 1, &FurRow::coverage_error, "mean difference of coverage where either picture has any"},
    {"gaps", "gaps %", 2, 100, &FurRow::gaps, "of what the traced strands cover by more than half, the share less than a quarter covered"},
    {"density_p95_over_p5", "density", 2, 1, &FurRow::density_p95_over_p5, "strands an area over the surface, 95th percentile over 5th"},
    {"shared_texel_area", "shared %", 1, 100, &FurRow::shared_texel_area, "share of the surface whose strand also grows at a distant place"},
    {"first_frame_ms", "first ms", 0, 1, &FurRow::first_frame_ms, "from the loaded mesh to the first picture in memory"},
    {"frame_ms", "frame ms", 1, 1, &FurRow::frame_ms, "median of a frame"},
};

std::string printed(double value, int digits) {
    if (!std::isfinite(value)) return "-";
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}
std::string shown(const FurRow& row, const Column& c) { return printed(row.*c.value * c.times, c.digits); }

// The best of each column among rows of one mesh and coat: all of them are better small.
bool best(const std::vector<FurRow>& rows, std::size_t first, std::size_t end, std::size_t at, const Column& c) {
    if (end - first < 2 || !std::isfinite(rows[at].*c.value)) return false;
    for (std::size_t i = first; i < end; ++i)
        if (rows[i].*c.value < rows[at].*c.value) return false;
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
        for (const Column& c : columns) row[c.id] = std::isfinite(r.*c.value) ? Json(r.*c.value) : Json();
        row["picture"] = r.picture;
        row["reference"] = r.reference;
        json["rows"].push_back(std::move(row));
    }
    return json.dump(1) + "\n";
}

std::string fur_comparison_csv(const FurComparison& f) {
    std::string text = "mesh,preset,mode,faces,strands,layers";
    for (const Column& c : columns) {
        text += ',';
        text += c.id;
    }
    text += "\n";
    for (const FurRow& r : f.rows) {
        text += csv_text(r.mesh) + "," + r.preset + "," + r.mode + "," + std::to_string(r.faces) + "," + std::to_string(r.strands) + "," + std::to_string(r.layers);
        for (const Column& c : columns) {
            text += ',';
            if (std::isfinite(r.*c.value)) text += printed(r.*c.value, 6);
        }
        text += "\n";
    }
    return text;
}

std::string fur_comparison_text(const FurComparison& f) {
    std::vector<std::vector<std::string>> cells{{"mesh", "preset", "mode", "strands", "layers"}};
    for (const Column& c : columns) cells[0].emplace_back(c.title);
    for (const FurRow& r : f.rows) {
        auto& line = cells.emplace_back(std::vector<std::string>{r.mesh, r.preset, r.mode, std::to_string(r.strands), std::to_string(r.layers)});
        for (const Column& c : columns) line.push_back(shown(r, c));
    }
    std::vector<std::size_t> widths(cells[0].size(), 0);
    for (const auto& line : cells)
        for (std::size_t c = 0; c < line.size(); ++c) widths[c] = std::max(widths[c], line[c].size());
    std::string text;
    for (const auto& line : cells) {
        for (std::size_t c = 0; c < line.size(); ++c) {
            const std::string pad(widths[c] - line[c].size(), ' ');
            if (c > 0) text += "  ";
            text += c < 3 ? line[c] + pad : pad + line[c];
        }
        text += "\n";
    }
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
        std::to_string(f.samples) + " rays a pixel. The light of the textured layers is fitted to such a picture first, as it is not their maps' fault; that of strands is what it is. Drawn at " +
        std::to_string(f.width) + " x " + std::to_string(f.height) + ", " + std::to_string(f.passes) + " passes averaged, by " + html_text(f.device) + ". Bold: the best of the table.</p><ul>";
    for (const Column& c : columns) page += std::string("<li><b>") + c.title + "</b>: " + c.help + "</li>";
    page += "</ul>\n";
    for (std::size_t first = 0; first < f.rows.size();) {
        const std::size_t end = end_of_group(f.rows, first);
        const FurRow& head = f.rows[first];
        page += "<h2>" + html_text(head.mesh) + ", " + html_text(head.preset) + "</h2><div class=scroll><table><thead><tr><th>mode</th><th>faces</th><th>strands</th><th>layers</th>";
        for (const Column& c : columns) page += std::string("<th>") + c.title + "</th>";
        page += "</tr></thead><tbody>";
        for (std::size_t i = first; i < end; ++i) {
            const FurRow& r = f.rows[i];
            page += "<tr><th>" + html_text(r.mode) + "</th><td>" + std::to_string(r.faces) + "</td><td>" + std::to_string(r.strands) + "</td><td>" + std::to_string(r.layers) + "</td>";
            for (const Column& c : columns) page += (best(f.rows, first, end, i, c) ? "<td class=best>" : "<td>") + shown(r, c) + "</td>";
            page += "</tr>";
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
