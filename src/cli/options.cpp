#include "cli/options.h"

#include "core/error.h"
#include "core/suggest.h"
#include "techniques/catalogue.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace relievo {

namespace {

template <class T>
bool read_number(std::string_view text, T& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

std::vector<std::string> split(const std::vector<std::string>& texts) {
    std::vector<std::string> parts;
    for (const std::string& text : texts) {
        std::istringstream stream(text);
        for (std::string part; std::getline(stream, part, ',');)
            if (!part.empty()) parts.push_back(part);
    }
    return parts;
}

template <class Table>
std::vector<std::string> ids(const Table& table) {
    std::vector<std::string> list;
    for (const auto& entry : table) list.emplace_back(entry.id);
    return list;
}

// "--light-radius" of light_radius.
std::string option_name(std::string_view id) {
    std::string name = "--" + std::string(id);
    std::ranges::replace(name, '_', '-');
    return name;
}

std::string plain(float value) {
    std::ostringstream out;
    out << value;
    return out.str();
}

}  // namespace

Size parse_size(const std::string& text) {
    constexpr int largest = 16384;  // the smallest maxImageDimension2D found on real desktop devices
    const auto x = text.find('x');
    Size size{};
    if (x == std::string::npos || !read_number(std::string_view(text).substr(0, x), size.width) ||
        !read_number(std::string_view(text).substr(x + 1), size.height) || size.width < 1 || size.height < 1 ||
        size.width > largest || size.height > largest)
        throw UsageError("--size '" + text + "' is not WIDTHxHEIGHT with sides from 1 to " + std::to_string(largest) + ", as in 640x360");
    return size;
}

std::vector<View> parse_views(const std::vector<std::string>& texts) {
    std::vector<View> result;
    for (const std::string& text : split(texts)) {
        const auto view = parse_view(text);
        if (!view) throw UsageError(unknown_word("view", text, ids(views())) + "\n  Degrees above the plane do too, from 1 to 90 (with a minus, from behind), and either with @ and how many times as far away, from 0.1 to 100: 20@4.");
        if (std::ranges::find(result, view->id, &View::id) == result.end()) result.push_back(*view);
    }
    if (result.empty() && !texts.empty()) throw UsageError("--view names no view");
    return result;
}

void require_front(const std::vector<View>& views, const char* verb) {
    for (const View& v : views)
        if (v.from_behind()) throw UsageError("--view " + v.id + " looks from behind, and " + verb + " shows the front; render and vary show both");
}

const Technique& parse_technique(const std::string& id, const std::vector<std::string>& also) {
    const Technique* technique = find_technique(id);
    if (technique != nullptr) return *technique;
    std::vector<std::string> known = ids(techniques());
    known.insert(known.end(), also.begin(), also.end());
    throw UsageError(unknown_word("technique", id, known));
}

std::vector<const Technique*> parse_techniques(const std::vector<std::string>& texts) {
    std::vector<const Technique*> result;
    for (const std::string& id : split(texts)) {
        const Technique* technique = &parse_technique(id);
        if (std::ranges::find(result, technique) == result.end()) result.push_back(technique);
    }
    if (result.empty() && !texts.empty()) throw UsageError("--technique names no technique");
    return result;
}

MarchParams parse_knobs(const Technique& technique, const std::vector<std::string>& settings) {
    MarchParams params = default_params(technique);
    for (const std::string& setting : split(settings)) {
        const auto equals = setting.find('=');
        if (equals == std::string::npos) throw UsageError("--set '" + setting + "' is not knob=value");
        const std::string id = setting.substr(0, equals);
        const KnobDefault* declared = nullptr;
        std::vector<std::string> known;
        for (const KnobDefault& k : technique.knobs) {
            known.emplace_back(k.knob->id);
            if (k.knob->id == id) declared = &k;
        }
        if (declared == nullptr) {
            if (known.empty()) throw UsageError("'" + std::string(technique.id) + "' has no knobs, so --set " + setting + " does nothing");
            throw UsageError(unknown_word("knob", id, known) + " (knobs of " + std::string(technique.id) + ")");
        }
        float value = 0;
        const Knob& k = *declared->knob;
        if (!read_number(std::string_view(setting).substr(equals + 1), value) || !(value >= k.min && value <= k.max) ||
            (k.is_integer() && value != std::floor(value)))
            throw UsageError("--set " + setting + ": " + id + " takes " + (k.is_integer() ? "a whole number" : "a number") + " from " +
                             plain(k.min) + " to " + plain(k.max));
        k.set(params, value);
    }
    return params;
}

void add_modifier_options(CLI::App& verb, DrawOptions& options) {
    for (const Modifier& m : modifiers()) {
        std::string help(m.help);
        for (const ModifierValue& v : m.values) help += "\n  " + std::string(v.id) + ": " + std::string(v.help);
        verb.add_option_function<std::string>(
                "--" + std::string(m.id),
                [&m, &options](const std::string& text) {
                    const auto it = std::ranges::find(m.values, text, &ModifierValue::id);
                    if (it == m.values.end()) throw UsageError(unknown_word(std::string(m.id), text, ids(m.values)));
                    options.*m.choice = static_cast<int>(it - m.values.begin());
                },
                help)
            ->default_str(std::string(m.value(options).id))
            ->group("Modifiers, which work with every technique");
        for (const ModifierNumber& n : modifier_numbers()) {
            if (n.of != &m) continue;
            const std::string name = option_name(n.id);
            verb.add_option_function<std::string>(
                    name,
                    [&n, &options, name](const std::string& text) {
                        float value = 0;
                        if (!read_number(std::string_view(text), value) || !(value >= n.min && value <= n.max) ||
                            (n.is_integer() && value != std::floor(value)))
                            throw UsageError(name + " " + text + ": takes " + (n.is_integer() ? "a whole number" : "a number") + " from " +
                                             plain(n.min) + " to " + plain(n.max));
                        n.set(options, value);
                    },
                    std::string(n.help) + (n.unit.empty() ? "" : ", " + std::string(n.unit)))
                ->default_str(plain(n.initial))
                ->group("Modifiers, which work with every technique");
        }
    }
}

}  // namespace relievo
