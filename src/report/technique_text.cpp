#include "report/technique_text.h"

#include "techniques/catalogue.h"
#include "techniques/knobs.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

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
