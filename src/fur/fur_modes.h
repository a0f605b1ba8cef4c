// The ways of growing fur that can be compared. Options, help, lists and chapters are loops over this table.
#pragma once

#include <span>
#include <string_view>

namespace relievo {

enum class FurKind { strands, shells, classic, lapped };

struct FurMode {
    FurKind kind;
    std::string_view id, title;
    std::string_view summary;  // one clause: what it does
    std::string_view author;
    int year;
    std::string_view source;   // the title of the paper
    std::string_view limits;   // where it fails
    std::string_view chapter;  // in docs
};

inline constexpr FurMode fur_modes[] = {
    {FurKind::lapped, "lapped", "Lapped patches", "one square of strands pasted along the comb again and again", "Lengyel, Praun, Finkelstein, Hoppe", 2001,
     "Real-Time Fur over Arbitrary Surfaces", "every patch has the same strands, twice as many where patches lap", "concepts/fur_lapped.md"},
    {FurKind::classic, "classic", "Layers by direction", "uniform layers, textured by a map that the normal and the position look up", "Evangelista", 2009,
     "Renderização em tempo real de pelos aplicados sobre malhas tridimensionais arbitrárias obtidas de objetos reais", "strands are sparse where the surface is bent, and distant places share them", "concepts/fur_classic.md"},
    {FurKind::shells, "shells", "Layers that look for strands", "layers whose pixels look for the strands around them, no texture", "relievo", 2026, "docs/concepts/fur.md",
     "strands that lean farther than their roots are apart are cut", "concepts/fur.md"},
    {FurKind::strands, "strands", "Strands in object space", "each strand plotted where it stands, no texture", "relievo", 2026, "docs/concepts/fur.md",
     "needs atomic minima of 64 bits in buffers", "concepts/fur.md"},
};

}  // namespace relievo
