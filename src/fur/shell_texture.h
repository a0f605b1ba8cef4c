// Fur for programs that know nothing of it: one texture that all layers share, each showing what of it is higher than itself.
#pragma once

#include "core/image.h"
#include "fur/coat.h"
#include "fur/roots.h"
#include "mesh/chart_atlas.h"

namespace relievo {

struct ShellTexture {
    Image8 texels;    // RGBA, row 0 at the bottom: colour sRGB-encoded, alpha as told below
    double covered = 0;  // share of the surface's texels in which a strand stands
};

// Alpha is the height, in shares of the coat's length, up to which a strand stands over the texel: strands are cones, and a layer at height h that
// drops texels of less alpha than h shows the circle that it cuts out of each. One texture is enough for any number of layers, and bilinear reading is
// right for it, as alpha falls evenly from a strand's axis outward. Colour is that of the strand at `way` 0.7; where none stands, the coat's mean.
// Strands that lean or curl cover at each height what they reach there or higher: single ones grow thicker by as much as they stray (spread and curl of the coat).
// The atlas is of a mesh near the one that roots grow on, `off` at most; `spacing` is their mean distance. Does not depend on `threads`.
ShellTexture shell_texture(const ChartAtlas& atlas, const Mesh& mesh, const Roots& roots, const Coat& coat, double spacing, double off, int threads = 0);

}  // namespace relievo
