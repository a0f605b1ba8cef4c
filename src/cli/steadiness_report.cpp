#include "cli/steadiness_report.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace relievo {

using Json = nlohmann::ordered_json;

namespace {

double rounded(double v) { return std::round(v * 1e5) / 1e5; }

}  // namespace

Json steadiness_json(const FurSteadiness& s) {
    Json rows = Json::array(), steps = Json::array();
    for (const FurSteadiness::Row& r : s.rows)
        rows.push_back({{"passes", r.passes},
                        {"change", rounded(r.mean.picture)},
                        {"reference_change", rounded(r.mean.reference)},
                        {"error_change", rounded(r.mean.error)},
                        {"worst_over_median", rounded(r.worst_over_median)},
                        {"layers_change", rounded(r.mean.layers)},
                        {"pop", rounded(r.pop)},
                        {"inside", r.inside()}});
    for (const FurSteadiness::Step& t : s.steps)
        steps.push_back({{"distance", rounded(t.distance)},
                         {"layers", t.layers},
                         {"change", rounded(t.change.picture)},
                         {"reference_change", rounded(t.change.reference)},
                         {"error_change", rounded(t.change.error)},
                         {"layers_change", rounded(t.change.layers)}});
    return {{"samples", s.samples}, {"passes", rows}, {"steps", steps}};
}

std::string steadiness_text(const FurSteadiness& s) {
    std::string text = "change from frame to frame, traced strands with " + std::to_string(s.samples) + " rays a pixel\n";
    text += "passes  picture   traced    error  worst/median      pop  inside\n";
    for (const FurSteadiness::Row& r : s.rows) {
        char line[128];
        std::snprintf(line, sizeof line, "%6d  %7.4f  %7.4f  %7.4f  %12.3f  %7.3f  %s\n", r.passes, r.mean.picture, r.mean.reference, r.mean.error, r.worst_over_median, r.pop, r.inside() ? "yes" : "no");
        text += line;
    }
    return text;
}

}  // namespace relievo
