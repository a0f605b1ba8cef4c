// Every technique's effects as measured, beside what was published of them.
#pragma once

#include "core/progress.h"
#include "effects/effects.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace relievo {

// A row of the published table of effects: G. Nobrega de Lima, "Mapeamento de Geometrias a partir de Texturas em Tempo Real",
// Universidade Federal do ABC, 2011, table 4.1. It was drawn up from the papers; nothing in it was measured.
struct PublishedEffects {
    std::string_view technique;  // id here, whether the catalogue has it or not
    std::string_view title;
    Effects effects;
};
std::span<const PublishedEffects> published_effects();
inline constexpr std::string_view published_effects_source = "Nobrega de Lima 2011, table 4.1";

// Why a measured effect is not the published one.
struct EffectDifference {
    std::string_view technique;
    std::string_view effect;  // id of an EffectKind
    std::string_view reason;
};
std::span<const EffectDifference> known_differences();

struct EffectCell {
    double share = 0;                // as EffectKind::number
    bool present = false;
    std::optional<bool> published;   // nothing where the published table has no such row
    bool differs() const { return published && *published != present; }
    std::string reason;              // of a difference; never empty where there is one
};

struct EffectRow {
    const Technique* technique = nullptr;
    std::array<EffectCell, effect_count> cells;  // in the order of effect_kinds()
};

struct EffectsTable {
    std::vector<EffectRow> rows;                       // in the order of the catalogue
    std::vector<const PublishedEffects*> not_measured; // published rows whose technique is not in the catalogue
};

// Measures every technique of the list on all cores; the result does not depend on their number (0: all).
EffectsTable effects_table(std::span<const Technique* const> techniques, int threads, const Progress& progress = {});

// The table as text: `markdown` for a page, else columns for a terminal, with the reasons of the differences under it.
std::string effects_text(const EffectsTable& table, bool markdown);

}  // namespace relievo
