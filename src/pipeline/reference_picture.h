// The exact picture of a stage, from rays to linear colours.
#pragma once

#include "core/frame.h"
#include "core/map_set.h"
#include "core/progress.h"
#include "scenes/scene.h"
#include "techniques/modifiers.h"

#include <span>

namespace relievo {

struct ReferencePicture {
    float height_scale = 0;
    float zero_level = 1;
    DrawOptions options{};  // a shadow that knows the light's size is judged by that of a light with one
    int threads = 0;  // 0: all cores; the picture does not depend on it
};

// One sample a pixel for each field of rays; the planes of hits are those of the first (reference_frame). Maps: height, normal,
// colour.
Frame reference_picture(const Stage& stage, const MapSet& maps, std::span<const RayField> rays, const ReferencePicture& settings,
                        const Progress& progress = {});

}  // namespace relievo
