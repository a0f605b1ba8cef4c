// One pair of axes: texels along the section to the right, height upward.
#pragma once

#include "explain/search.h"
#include "figure/clip.h"
#include "figure/drawing.h"

#include <optional>

namespace relievo {

struct Panel {
    Rect box;  // pixels
    double x_left = 0, x_right = 1;
    double z_bottom = 0, z_top = 1;
    std::optional<Rect> frame = {};  // pixels: what another panel shows enlarged

    double px_per_texel() const { return box.width() / (x_right - x_left); }
    double px_per_height() const { return box.height() / (z_top - z_bottom); }
    Vec2d at(double x, double z) const { return {box.left + (x - x_left) * px_per_texel(), box.bottom - (z - z_bottom) * px_per_height()}; }
};

// When the two hits are named: where they are seen apart, or always.
enum class PanelText { where_apart, always };

// The section, and over it the steps, the ray and both hits of a search. Steps get their numbers where there is room. Labels avoid
// each other; what the panel cuts off is not drawn.
void draw_panel(Drawing& drawing, const Panel& panel, const Section& section, const HeightField& field, const Search& search, PanelText text);

}  // namespace relievo
