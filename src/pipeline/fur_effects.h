// What tells ways of growing fur apart, each measured on a scene in which it can only be there or not.
#pragma once

#include "core/progress.h"
#include "fur/fur_modes.h"
#include "pipeline/coat_painter.h"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace relievo {

// One effect: what is looked at, and from where on it counts as there. Nothing may lie between `absent_to` and `present_from`: a mode in the
// gap needs a better scene or a better claim.
struct FurEffectKind {
    std::string_view id;
    std::string_view title;
    std::string_view scene;   // what can only be there or not
    std::string_view number;  // what is measured, as a share
    double present_from;
    double absent_to;
    bool FurEffects::*claim;  // the row of fur_modes
    // `grown`: of the length that the scene takes strands to have, the share they are given. 1 measures the mode; with fur_stubble nothing that
    // comes from length may be found.
    double (*measure)(CoatPainter& painter, double grown);
};

inline constexpr double fur_stubble = 0.1;  // what scenes compare full length with

inline constexpr int fur_effect_count = 5;
std::span<const FurEffectKind> fur_effect_kinds();

struct FurEffectRow {
    const FurMode* mode = nullptr;
    std::array<double, fur_effect_count> shares{};  // in the order of fur_effect_kinds()
};

// Every row of fur_modes, in their order. Devices are chosen as by GpuRenderer. Throws Error.
std::vector<FurEffectRow> fur_effects_table(const std::string& device, const Progress& progress = {});

// `markdown` for a page, else columns for a terminal.
std::string fur_effects_text(std::span<const FurEffectRow> rows, bool markdown);

}  // namespace relievo
