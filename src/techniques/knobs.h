// The table of knobs: what may be turned on a technique, each written once. The CLI's --set, the viewer's sliders, the contract
// tests and the docs walk it.
#pragma once

#include "techniques/glsl.h"

#include <array>
#include <string_view>
#include <variant>

namespace relievo {

using MarchParams = glsl::MarchParams;

struct Knob {
    std::string_view id;
    std::string_view title;
    std::string_view unit;  // empty for plain counts
    std::string_view help;
    float min;
    float max;
    float step;
    std::variant<int MarchParams::*, float MarchParams::*> member;

    float get(const MarchParams& params) const {
        return std::visit([&](auto m) { return static_cast<float>(params.*m); }, member);
    }
    // Clamps to the range; whole-number knobs round to nearest.
    void set(MarchParams& params, float value) const;
    bool is_integer() const { return std::holds_alternative<int MarchParams::*>(member); }
};

namespace knob {

inline constexpr Knob max_steps{
    .id = "max_steps",
    .title = "Steps",
    .unit = "",
    .help = "most steps of the search down the ray (nodes visited, where the search is hierarchical)",
    .min = 1,
    .max = 4096,
    .step = 1,
    .member = &MarchParams::max_steps,
};
inline constexpr Knob min_steps{
    .id = "min_steps",
    .title = "Steps seen from above",
    .unit = "",
    .help = "steps when looking straight down; the count grows to max_steps at the horizon",
    .min = 1,
    .max = 4096,
    .step = 1,
    .member = &MarchParams::min_steps,
};
inline constexpr Knob refine_steps{
    .id = "refine_steps",
    .title = "Refinements",
    .unit = "",
    .help = "refinements of the interval that holds the surface: halvings, secants, or searches in shorter steps",
    .min = 0,
    .max = 32,
    .step = 1,
    .member = &MarchParams::refine_steps,
};
inline constexpr Knob contact_steps{
    .id = "contact_steps",
    .title = "Steps at contact",
    .unit = "",
    .help = "shorter steps into which the step that met the surface is cut at each refinement",
    .min = 2,
    .max = 64,
    .step = 1,
    .member = &MarchParams::contact_steps,
};
inline constexpr Knob iterations{
    .id = "iterations",
    .title = "Iterations",
    .unit = "",
    .help = "repetitions of the parallax estimate",
    .min = 1,
    .max = 64,
    .step = 1,
    .member = &MarchParams::iterations,
};
inline constexpr Knob tolerance{
    .id = "tolerance",
    .title = "Tolerance",
    .unit = "height",
    .help = "gap to the surface, as a share of the relief's amplitude, at which the search stops",
    .min = 1e-5f,
    .max = 1e-1f,
    .step = 1e-5f,
    .member = &MarchParams::tolerance,
};

}  // namespace knob

inline constexpr std::array knobs{&knob::max_steps, &knob::min_steps, &knob::refine_steps, &knob::contact_steps, &knob::iterations, &knob::tolerance};

// The knob with this id, or null.
const Knob* find_knob(std::string_view id);

}  // namespace relievo
