#include "effects/effects_table.h"

#include "core/parallel_for.h"
#include "techniques/catalogue.h"

#include <algorithm>
#include <cstdio>

namespace relievo {

namespace {

std::string share_text(double share) {
    char text[16];
    std::snprintf(text, sizeof text, "%.2f", share == 0 ? 0.0 : share);  // never "-0.00"
    return text;
}

std::string cell_text(const EffectCell& cell) {
    std::string text = std::string(cell.present ? "yes " : "no  ") + share_text(cell.share);
    if (cell.published) text += std::string(cell.differs() ? " # " : " = ") + (*cell.published ? "yes" : "no");
    return text;
}

std::string cell_markdown(const EffectCell& cell, int note) {
    std::string text = std::string(cell.present ? "**yes** " : "no ") + share_text(cell.share);
    if (cell.differs()) text += std::string(", published ") + (*cell.published ? "yes" : "no") + " [" + std::to_string(note) + "]";
    return text;
}

std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(width, text.size()), ' ');
    return text;
}

std::string claim_text(const Effects& effects) {
    std::string text;
    for (const EffectKind& kind : effect_kinds())
        if (effects.*kind.claim) text += (text.empty() ? "" : ", ") + std::string(kind.title);
    return text.empty() ? "none" : text;
}

}  // namespace

EffectsTable effects_table(std::span<const Technique* const> list, int threads, const Progress& progress) {
    EffectsTable result;
    result.rows.resize(list.size());
    const auto measure = [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            const Technique& technique = *list[static_cast<std::size_t>(i)];
            EffectRow& row = result.rows[static_cast<std::size_t>(i)];
            row.technique = &technique;
            const auto published = std::ranges::find(published_effects(), technique.id, &PublishedEffects::technique);
            for (std::size_t k = 0; k < effect_count; ++k) {
                const EffectKind& kind = effect_kinds()[k];
                EffectCell& cell = row.cells[k];
                cell.share = kind.measure(technique);
                cell.present = cell.share >= kind.present_from;
                if (published != published_effects().end()) cell.published = published->effects.*kind.claim;
                if (!cell.differs()) continue;
                cell.reason = "not explained yet";
                for (const EffectDifference& d : known_differences())
                    if (d.technique == technique.id && d.effect == kind.id) cell.reason = d.reason;
            }
        }
    };
    parallel_for(static_cast<int>(list.size()), 1, threads, measure, progress, "measuring effects");
    for (const PublishedEffects& p : published_effects())
        if (find_technique(p.technique) == nullptr) result.not_measured.push_back(&p);
    return result;
}

std::string effects_text(const EffectsTable& table, bool markdown) {
    std::string text;
    std::vector<std::string> notes;
    const auto line = [&](const std::string& first, const auto& of) {
        text += markdown ? "| " + first : padded(first, 28);
        for (std::size_t k = 0; k < effect_count; ++k) text += markdown ? " | " + of(k) : padded(of(k), 20);
        while (text.back() == ' ') text.pop_back();
        text += markdown ? " |\n" : "\n";
    };
    line("technique", [&](std::size_t k) { return std::string(markdown ? effect_kinds()[k].title : effect_kinds()[k].id); });
    if (markdown) text += "|---|---|---|---|---|\n";
    for (const EffectRow& row : table.rows)
        line(markdown ? "[" + std::string(row.technique->title) + "](techniques/" + std::string(row.technique->id) + ".md)" : std::string(row.technique->id),
             [&](std::size_t k) {
                 const EffectCell& cell = row.cells[k];
                 if (cell.differs())
                     notes.push_back(std::string(row.technique->id) + ", " + std::string(effect_kinds()[k].id) + " (published " + (*cell.published ? "yes" : "no") +
                                     ", measured " + share_text(cell.share) + "): " + cell.reason);
                 return markdown ? cell_markdown(cell, static_cast<int>(notes.size())) : cell_text(cell);
             });
    if (!markdown) text += "\nA cell is: measured, share, = (as published) or # (not as published), published. Published: " + std::string(published_effects_source) + ".\n";
    if (!notes.empty()) text += markdown ? "\n## Where the published table says otherwise\n\n" : "\nNot as published:\n";
    for (std::size_t i = 0; i < notes.size(); ++i) text += (markdown ? std::to_string(i + 1) + ". " : "  # ") + notes[i] + ".\n";
    if (!table.not_measured.empty()) {
        text += markdown ? "\n## Published, not in the catalogue\n\n| technique | published effects |\n|---|---|\n" : "\nPublished, but not in the catalogue, so not measured:\n";
        for (const PublishedEffects* p : table.not_measured)
            text += markdown ? "| " + std::string(p->title) + " | " + claim_text(p->effects) + " |\n" : "  " + padded(std::string(p->title), 44) + claim_text(p->effects) + "\n";
    }
    return text;
}

}  // namespace relievo
