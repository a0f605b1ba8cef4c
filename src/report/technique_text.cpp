#include "report/technique_text.h"

#include "techniques/catalogue.h"
#include "techniques/knobs.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace relievo {

std::string technique_title(std::string_view id) {
    const Technique* technique = find_technique(id);
    return std::string(technique ? technique->title : id);
}

std::string inside_sentence(std::string text) {
    // A second capital marks an abbreviation ("PSNR"), which stays as it is.
    if (text.size() > 1 && !std::isupper(static_cast<unsigned char>(text[1])))
        text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
    return text;
}

std::string readable_name(std::string name) {
    std::ranges::replace(name, '_', ' ');
    return name;
}

std::string short_number(double value) {
    if (value == 0) return "0";
    const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", std::clamp(1 - exponent, 0, 12), value);
    return text;
}

std::string percent(double share) { return short_number(100 * share) + "\u202f%"; }

std::string promise_text(const Technique& technique) {
    // Where a promise depends on the view, it is told for the one that the figures use.
    constexpr double elevation_deg = 30;
    const float view_z = static_cast<float>(std::sin(elevation_deg * std::numbers::pi / 180));
    const Promise p = promise_of(technique, default_params(technique), view_z);
    std::string where;
    if (technique.exact) {
        where = "The first hit, up to rounding";
    } else if (p.relief > 0) {
        const std::string polygon = p.unmoved > 0 ? short_number(p.unmoved) + " times the hit's distance from the polygon and " : "";
        where = "Seen at 30 degrees, a hit is off by no more than " + polygon + (p.relief == 1 ? "" : short_number(p.relief) + " times ") +
                "the differences of height between polygon and hit" + (p.polygon ? ", or than the polygon itself" : "");
    } else if (p.polygon) {
        where = "The polygon: off by as much as the relief lies away from it";
    } else {
        where = "Within " + short_number(p.error) + " of the relief's height" + (p.texels > 0 ? " and " + short_number(p.texels) + " texel" : "") + " of a crossing of ray and surface";
        if (p.stride >= 1) where += ", whichever";
        else if (p.stride > 0) where += "; the first, unless the ray is inside the relief for less than " + short_number(p.stride) + " of its height there";
        else where += "; the first, unless the ray is inside the relief for less than that there";
    }
    std::string share = ". So it is for all rays";
    const Budget& b = technique.budget;
    if (b.astray > 0 || b.per_wall > 0) {
        share += " but " + (b.astray > 0 ? percent(static_cast<double>(b.astray)) + (b.per_wall > 0 ? " and " : "") : "");
        if (b.per_wall > 0) share += percent(static_cast<double>(b.per_wall)) + " for each wall on their way (the mean slope over that of the ray)";
    }
    return where + share + ".";
}

std::string setting_text(const KnobValues& values) {
    std::string text;
    for (const auto& [id, value] : values) {
        const Knob* knob = find_knob(id);
        char number[32];
        std::snprintf(number, sizeof number, "%.6g", value);
        text += (text.empty() ? "" : ", ") + std::string(number) + " ";
        std::string noun = knob ? inside_sentence(std::string(knob->title)) : readable_name(id);
        // Titles of counts are plurals: "Steps seen from above" becomes "1 step seen from above".
        const std::size_t word_end = std::min(noun.find(' '), noun.size());
        if (value == 1 && word_end > 1 && noun[word_end - 1] == 's') noun.erase(word_end - 1, 1);
        text += noun;
    }
    return text;
}

}  // namespace relievo
