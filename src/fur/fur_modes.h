// The ways of growing fur that can be compared. Options, help, lists and chapters are loops over this table.
#pragma once

#include "fur/fur_errors.h"

#include <string_view>

namespace relievo {

enum class FurKind { strands, shells, classic, lapped };

// What a mode shows; a test measures each (pipeline/fur_effects.h has scenes and thresholds).
struct FurEffects {
    bool parallax = false;     // strands move against the skin while the mesh turns
    bool occlusion = false;    // strands hide what is behind them
    bool self_shadow = false;  // and take its light
    bool silhouette = false;   // fur is seen beyond the mesh's own outline
    bool even_roots = false;   // as many strands on every part of the surface
};

struct FurMode {
    FurKind kind;
    std::string_view id, title;
    std::string_view summary;  // one clause: what it does
    std::string_view author;
    int year;
    std::string_view source;   // the title of the paper
    std::string_view limits;   // where it fails
    std::string_view chapter;  // in docs
    // The most that its pictures may be off by, on any mesh and in any coat (docs/concepts/promises.md says how it was set).
    FurErrors budget;
    // The share of its light, seen without single strands, that a picture may change by when every face of the mesh is cut into sixteen.
    double finer_mesh = 0;
    FurEffects effects;
};

inline constexpr FurMode fur_modes[] = {
    {FurKind::lapped, "lapped", "Lapped patches", "one square of strands pasted along the comb again and again", "Lengyel, Praun, Finkelstein, Hoppe", 2001,
     "Real-Time Fur over Arbitrary Surfaces", "every patch has the same strands, twice as many where patches lap", "concepts/fur_lapped.md",
     {.flip = 0.23, .coverage_error = 0.32, .gaps = 0.0101, .density_p95_over_p5 = 9}, 0.11,
     {.parallax = true, .occlusion = true, .silhouette = true}},
    {FurKind::classic, "classic", "Layers by direction", "uniform layers, textured by a map that the normal and the position look up", "Evangelista", 2009,
     "Renderização em tempo real de pelos aplicados sobre malhas tridimensionais arbitrárias obtidas de objetos reais", "strands are sparse where the surface is bent, and distant places share them", "concepts/fur_classic.md",
     {.flip = 0.28, .coverage_error = 0.42, .gaps = 0.0026, .density_p95_over_p5 = not_promised}, 0.06,
     {.parallax = true, .occlusion = true, .silhouette = true}},
    {FurKind::shells, "shells", "Layers that look for strands", "layers whose pixels look for the strands around them, no texture", "relievo", 2026, "docs/concepts/fur.md",
     "strands that lean farther than their roots are apart are cut", "concepts/fur.md",
     {.flip = 0.15, .coverage_error = 0.14, .gaps = 0.042, .density_p95_over_p5 = 1.7}, 0.12,
     {.parallax = true, .occlusion = true, .self_shadow = true, .silhouette = true, .even_roots = true}},
    {FurKind::strands, "strands", "Strands in object space", "each strand plotted where it stands, no texture", "relievo", 2026, "docs/concepts/fur.md",
     "needs atomic minima of 64 bits in buffers", "concepts/fur.md",
     {.flip = 0.14, .coverage_error = 0.07, .gaps = 0.002, .density_p95_over_p5 = 1.7}, 0.13,
     {.parallax = true, .occlusion = true, .self_shadow = true, .silhouette = true, .even_roots = true}},
};

constexpr const FurMode& fur_mode(FurKind kind) {
    for (const FurMode& m : fur_modes)
        if (m.kind == kind) return m;
    return fur_modes[0];
}

}  // namespace relievo
