// Frames to files: the picture one looks at, and the facts under each of its pixels.
#pragma once

#include "core/frame.h"

#include <filesystem>

namespace relievo {

// Frame.colour (linear RGB) as an 8-bit sRGB PNG: clamped to [0,1], IEC 61966-2-1 transfer, no tone curve. Throws Error.
void write_frame_png(const std::filesystem::path& file, const ImageF& colour);

// Every plane of the frame in one float EXR, row 0 at the top: R, G, B (linear), hit.U, hit.V, height, normal.X/Y/Z, fetches,
// mask (values of Coverage: 0 background, 1 hit, 2 no hit) and shadow. Throws Error.
void write_frame_exr(const std::filesystem::path& file, const Frame& frame);

}  // namespace relievo
