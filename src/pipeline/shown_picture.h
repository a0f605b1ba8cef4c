// Pictures as a display shows them: eight bits, sRGB-encoded, row 0 at the top.
#pragma once

#include "core/image.h"

#include <filesystem>

namespace relievo {

// Linear RGB clamped to [0,1] and encoded, four channels with alpha 255: the very values of the PNG of a picture.
Image8 shown_picture(const ImageF& linear_rgb);

// Throws Error if a file cannot be written here; leaves nothing. To know before the work is done.
void require_writable(const std::filesystem::path& file);

// As PNG, whole or not at all. Throws Error.
void write_shown_picture(const std::filesystem::path& file, const Image8& picture);

}  // namespace relievo
