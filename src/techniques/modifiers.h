// The table of modifiers: what may be turned on any technique of the height-field family, whatever it is. A modifier is a choice
// among a few ways of doing one thing round the search (a constant of the GPU program), or a number that goes with some of them.
// The program's options, the window's menus, the report's conditions, tests and docs walk it.
#pragma once

#include "techniques/technique.h"

#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace relievo {

// Values of DrawOptions::sides.
inline constexpr int sides_front = 0;
inline constexpr int sides_both = 1;

// One value for each modifier. The defaults change nothing: the technique alone, with the hard shadow it casts itself.
struct DrawOptions : glsl::DrawModes {
    int sides;  // of the polygon that show anything; no program needs to know
    glsl::DrawNumbers numbers{};
    DrawOptions();  // the table's defaults
};

struct ModifierValue {
    std::string_view id;
    std::string_view help;
    Source source = {};  // no author: common practice
};

struct Modifier {
    std::string_view id;
    std::string_view title;
    std::string_view help;
    std::span<const ModifierValue> values;  // a choice is an index into these
    int DrawOptions::*choice;
    int usual;  // the value that changes nothing
    int truth;  // the value whose exact picture all are judged by; -1: each by its own

    const ModifierValue& value(const DrawOptions& options) const { return values[static_cast<std::size_t>(options.*choice)]; }
};

struct ModifierNumber {
    std::string_view id;
    std::string_view title;
    std::string_view unit;  // of the value as people give it
    std::string_view help;
    float min;
    float max;
    float step;
    float initial;
    float to_unit;  // what the shaders receive, over what people give (radians per degree)
    std::variant<int glsl::DrawNumbers::*, float glsl::DrawNumbers::*> member;
    const Modifier* of;
    std::uint32_t values;  // bit i: it counts where the modifier has its i-th value

    float get(const DrawOptions& options) const;
    // Clamps to the range; whole numbers round to nearest.
    void set(DrawOptions& options, float value) const;
    bool is_integer() const { return std::holds_alternative<int glsl::DrawNumbers::*>(member); }
    // Whether it changes anything under these options.
    bool counts(const DrawOptions& options) const { return (values >> (options.*of->choice) & 1u) != 0; }
};

std::span<const Modifier> modifiers();
std::span<const ModifierNumber> modifier_numbers();

// Edge of the square of UV that holds the relief, where it does not repeat: the texture's own [0,1]^2, or the polygon's chart, which
// is as many repeats wide as the base; 0 where it does.
float chart_of(const DrawOptions& options, float periods);

const Modifier* find_modifier(std::string_view id);

// The maps that shading needs beside the technique's own, under these options.
MapFlags maps_of(const DrawOptions& options);

// Whether the technique casts the shadow itself, ray by ray; the others ask the maps.
constexpr bool traces_shadow(int shadow) { return shadow == glsl::shadow_hard || shadow == glsl::shadow_area; }
// The shadow that a technique draws: none where it would have to trace rays and cannot.
int shadow_of(const Technique& technique, const DrawOptions& options);
// Whether the light's size enters, so that the truth is that of a light with one.
constexpr bool has_penumbra(int shadow) { return shadow != glsl::shadow_none && shadow != glsl::shadow_hard; }

// "shadow=horizon light_radius=4": the modifiers that are not at their defaults, and the numbers that count; empty if none.
std::string described(const DrawOptions& options);

}  // namespace relievo
