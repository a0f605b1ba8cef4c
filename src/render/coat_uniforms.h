// The numbers and matrices that the programs of strands receive, plotted or in shells (shaders/shared/coat.h).
#pragma once

#include "fur/coat.h"
#include "render/fur_frames.h"

#include <array>

namespace relievo {

#include "shared/coat.h"

// Push constants of all these programs: 128 bytes, what every Vulkan device takes. Columns first.
struct FurMatrices {
    std::array<float, 16> to_clip;   // from fur space, of the eye or of the light
    std::array<float, 16> to_light;  // from fur space to the light's picture: x and y in [0,1], z the distance from its plane
    bool operator==(const FurMatrices&) const = default;
};

// How a pass of several differs from the others. The only one of a picture is as a frame of a film would show it; several move samples
// and light a little.
struct FurPass {
    FurMatrices eye, light;
    float sample_shift = 0;  // CoatUniforms::sample_shift
};
FurPass fur_pass(const FurView& view, int pass, float fur_length);

// What a coat and a view set; everything else is 0. `spacing` is the mean distance of roots, in fur space.
CoatUniforms coat_uniforms(const Coat& coat, float spacing);
void set_view(CoatUniforms& uniforms, const FurView& view);

}  // namespace relievo
