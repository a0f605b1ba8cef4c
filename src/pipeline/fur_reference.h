// The same fur as curves, ray traced: what a picture in layers is compared with.
#pragma once

#include "core/progress.h"
#include "fur/strand_curves.h"
#include "render/fur_renderer.h"

namespace relievo {

// Camera and lights of the view, `samples` rays a pixel, each to the key light again: every strand it meets on the way keeps a quarter of it,
// as most of what strands scatter goes on forward, and skin all of it. The same light as the programs that draw layers compute, in
// double and written anew. `skin` has unit normals; `lengths` are those of its vertices, as in SkinValues, and tell where it is bare. Does not depend on `threads`.
FurFrames trace_fur(const StrandCurves& curves, const Mesh& skin, const Coat& coat, const FurView& view, int samples, int threads = 0, const Progress& progress = {},
                    std::span<const float> lengths = {});

}  // namespace relievo
