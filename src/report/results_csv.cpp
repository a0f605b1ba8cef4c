#include "report/escaped.h"
#include "report/measurement_fields.h"
#include "report/results.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace relievo {

namespace {

// Nine digits tell any two floats apart; more would be noise of the printing.
std::string number(double v) {
    if (!std::isfinite(v)) return {};
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", v);
    return text;
}

}  // namespace

std::string results_csv(const Results& results) {
    std::vector<std::string> knobs;  // a column per knob that any row has, in order of first appearance
    for (const Row& r : results.rows)
        for (const auto& [id, value] : r.knobs)
            if (std::ranges::find(knobs, id) == knobs.end()) knobs.push_back(id);

    std::string csv;
    const auto put = [&csv](const std::string& field) {
        if (!csv.empty() && csv.back() != '\n') csv += ',';
        csv += csv_text(field);
    };
    for (const char* name : {"technique", "material", "view", "elevation_deg"}) put(name);
    for (const std::string& id : knobs) put(id);
    const Measurement names;
    each_field(names, [&](const std::string& name, const auto& measured) {
        std::decay_t<decltype(*measured)> value{};
        each_part(value, [&](const std::string& part, double) { put(part.empty() ? name : name + "_" + part); });
    });
    put("inside_budget");
    for (const char* name : {"image", "error_image", "reference_image", "fetches_image"}) put(name);
    csv += "\r\n";

    for (const Row& r : results.rows) {
        csv += csv_text(r.technique);  // never empty, so that put() sees that a line has begun
        for (const std::string& field : {r.material, r.view, number(r.elevation_deg)}) put(field);
        for (const std::string& id : knobs) {
            const auto it = std::ranges::find(r.knobs, id, &KnobValues::value_type::first);
            put(it == r.knobs.end() ? std::string{} : number(it->second));
        }
        each_field(r.m, [&](const char*, const auto& measured) {
            std::decay_t<decltype(*measured)> value{};
            if (measured) value = *measured;
            each_part(value, [&](const char*, double v) { put(measured ? number(v) : std::string{}); });
        });
        const Measured<bool> inside = inside_budget(r.m);
        put(!inside ? "" : *inside ? "yes" : "no");
        for (const std::string& path : {r.image, r.error_image, r.reference_image, r.fetches_image}) put(path);
        csv += "\r\n";
    }
    return csv;
}

}  // namespace relievo
