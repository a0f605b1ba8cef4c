// What everything that draws returns and everything that judges takes: one picture with the facts under each pixel.
#pragma once

#include "core/image.h"

#include <cstdint>
#include <string>
#include <vector>

namespace relievo {

enum class Coverage : std::uint8_t {
    background = 0,  // the pixel's ray does not meet the base
    hit = 1,         // the technique found the surface
    no_hit = 2,      // it meets the base, but the technique found no surface in the slab
};

// Row 0 is the top of the screen. All planes are width x height, taken at pixel centres; only `colour` may average several
// samples per pixel. Where coverage is not `hit` the other planes hold 0.
struct Frame {
    int width = 0;
    int height = 0;
    ImageF colour;           // 3 channels, linear RGB, scene light; background included
    Image8 coverage;         // 1 channel, values of Coverage
    ImageF hit_uv;           // 2 channels, texture coordinates of the hit, not wrapped
    ImageF hit_height;       // 1 channel, height of the hit in [0,1]
    ImageF normal;           // 3 channels, unit shading normal in tangent space
    ImageF shadow;           // 1 channel, share of the key light that arrives: 1 lit, 0 in self-shadow
    ImageF fetches;          // 1 channel, texture fetches of the search for the hit (a 4-texel gather counts as one); 0 if unknown
    std::vector<double> gpu_ms;  // duration of each timed run, milliseconds; empty if not timed
    std::string source;      // what drew it: "gpu: llvmpipe ...", "cpu", "reference"

    Frame() = default;
    Frame(int width_, int height_)
        : width(width_), height(height_), colour(width_, height_, 3), coverage(width_, height_, 1), hit_uv(width_, height_, 2),
          hit_height(width_, height_, 1), normal(width_, height_, 3), shadow(width_, height_, 1), fetches(width_, height_, 1) {}
};

// Rays flatter than this cosine to the normal are followed as if they had it, by every technique and by the reference: the
// question has to be the same, and without a limit a horizontal ray never ends. 0.03 degrees.
inline constexpr double flattest_cosine = 0.0005;

// The rays of a picture as the machine that draws it sees them, in tangent space, so that every technique and the reference are
// asked the same question. Same layout as Frame.
struct RayField {
    int width = 0;
    int height = 0;
    Image8 coverage;   // background or hit (= meets the base)
    ImageF uv;         // 2 channels: where the ray meets the polygon (height = zero_level)
    ImageF view;       // 3 channels: unit vector from the surface to the eye, tangent space
    ImageF lod;        // 1 channel: mip level of an undisplaced texel footprint, relative to a map of 1x1 texel (log2 of the
                       // footprint's longer side in UV units); a map of n texels is read at level max(0, lod + log2 n)

    RayField() = default;
    RayField(int width_, int height_)
        : width(width_), height(height_), coverage(width_, height_, 1), uv(width_, height_, 2), view(width_, height_, 3),
          lod(width_, height_, 1) {}
};

}  // namespace relievo
