#include "techniques/modifiers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace relievo {

namespace {

using Numbers = glsl::DrawNumbers;
using Options = DrawOptions;

constexpr Source mile{"Mile", 2008, "Shader nyelvek lehetőségei: Felület részleteinek megjelenítése"};
constexpr Source tatarchuk{"Tatarchuk", 2006, "Dynamic Parallax Occlusion Mapping with Approximate Soft Shadows"};

constexpr ModifierValue shadow_values[] = {
    {"none", "every point is lit"},
    {"hard", "the technique asked again from the light, a point", {"Policarpo, Oliveira, Comba", 2005, "Real-Time Relief Mapping on Arbitrary Polygonal Surfaces"}},
    {"soft", "by how deep the light ray dips below the field", mile},
    {"tatarchuk", "by eight heights along the light ray, the nearer the weightier", tatarchuk},
    {"horizon", "by a map of the horizon in 16 directions", {"Max", 1988, "Horizon Mapping: Shadows for Bump-Mapped Surfaces"}},
    {"area", "the technique asked from many points of the light's disc"},
};

constexpr Modifier table[] = {
    {
        .id = "shadow",
        .title = "Shadow",
        .help = "how the relief's shadow on itself is found",
        .values = shadow_values,
        .choice = &Options::shadow,
        .truth = glsl::shadow_area,
    },
};
enum Row { shadow_row };

constexpr std::uint32_t bit(int value) { return 1u << value; }

constexpr ModifierNumber number_table[] = {
    {
        .id = "light_radius",
        .title = "Light's radius",
        .unit = "degrees",
        .help = "of the key light's disc as seen from the surface; the sun's is 0.27",
        .min = 0,
        .max = 20,
        .step = 0.1f,
        .initial = 3,
        .to_unit = std::numbers::pi_v<float> / 180,
        .member = &Numbers::light_radius,
        .of = &table[shadow_row],
        .values = bit(glsl::shadow_soft) | bit(glsl::shadow_tatarchuk) | bit(glsl::shadow_horizon) | bit(glsl::shadow_area),
    },
    {
        .id = "shadow_depth",
        .title = "Black at depth",
        .unit = "height",
        .help = "penetration of the light ray at which a soft shadow is black",
        .min = 0.001f,
        .max = 1,
        .step = 0.001f,
        .initial = 0.15f,
        .to_unit = 1,
        .member = &Numbers::shadow_depth,
        .of = &table[shadow_row],
        .values = bit(glsl::shadow_soft),
    },
    {
        .id = "shadow_softening",
        .title = "Softening",
        .unit = "",
        .help = "factor on the blocking that the eight samples see",
        .min = 0.01f,
        .max = 10,
        .step = 0.01f,
        .initial = 0.58f,
        .to_unit = 1,
        .member = &Numbers::shadow_softening,
        .of = &table[shadow_row],
        .values = bit(glsl::shadow_tatarchuk),
    },
    {
        .id = "shadow_samples",
        .title = "Shadow samples",
        .unit = "",
        .help = "heights along the light ray, or rays to the light's disc",
        .min = 1,
        .max = 256,
        .step = 1,
        .initial = 16,
        .to_unit = 1,
        .member = &Numbers::shadow_samples,
        .of = &table[shadow_row],
        .values = bit(glsl::shadow_soft) | bit(glsl::shadow_area),
    },
};

// In order of the constants that name the values (shared/draw_options.h).
static_assert(shadow_values[glsl::shadow_none].id == "none" && shadow_values[glsl::shadow_hard].id == "hard" &&
              shadow_values[glsl::shadow_soft].id == "soft" && shadow_values[glsl::shadow_tatarchuk].id == "tatarchuk" &&
              shadow_values[glsl::shadow_horizon].id == "horizon" && shadow_values[glsl::shadow_area].id == "area");

std::string plain(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", static_cast<double>(value));
    return text;
}

}  // namespace

DrawOptions::DrawOptions() {
    for (const ModifierNumber& n : number_table) n.set(*this, n.initial);
}

float ModifierNumber::get(const DrawOptions& options) const {
    return std::visit([&](auto m) { return static_cast<float>(options.numbers.*m); }, member) / to_unit;
}

void ModifierNumber::set(DrawOptions& options, float value) const {
    const float kept = std::clamp(value, min, max) * to_unit;
    std::visit(
        [&](auto m) {
            using T = std::remove_reference_t<decltype(options.numbers.*m)>;
            options.numbers.*m = is_integer() ? static_cast<T>(std::lround(kept)) : static_cast<T>(kept);
        },
        member);
}

std::span<const Modifier> modifiers() { return table; }
std::span<const ModifierNumber> modifier_numbers() { return number_table; }

const Modifier* find_modifier(std::string_view id) {
    const auto it = std::ranges::find(table, id, &Modifier::id);
    return it == std::end(table) ? nullptr : it;
}

MapFlags maps_of(const DrawOptions& options) {
    MapFlags maps;
    maps.set(index_of(Map::normal)).set(index_of(Map::colour));
    if (options.shadow == glsl::shadow_soft || options.shadow == glsl::shadow_tatarchuk) maps.set(index_of(Map::height));
    if (options.shadow == glsl::shadow_horizon) maps.set(index_of(Map::height)).set(index_of(Map::horizon));
    return maps;
}

int shadow_of(const Technique& technique, const DrawOptions& options) {
    return traces_shadow(options.shadow) && !technique.effects.self_shadow ? glsl::shadow_none : options.shadow;
}

std::string described(const DrawOptions& options) {
    const DrawOptions usual;
    std::string text;
    const auto add = [&](std::string_view id, const std::string& value) {
        text.append(text.empty() ? "" : " ").append(id).append("=").append(value);
    };
    for (const Modifier& m : table) {
        if (options.*m.choice != usual.*m.choice) add(m.id, std::string(m.value(options).id));
        for (const ModifierNumber& n : number_table)
            if (n.of == &m && n.counts(options)) add(n.id, plain(n.get(options)));
    }
    return text;
}

}  // namespace relievo
