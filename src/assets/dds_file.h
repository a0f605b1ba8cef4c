// Textures as DDS files: block-compressed, with their mip levels, one picture or the six faces of a cube.
#pragma once

#include "core/image.h"

#include <filesystem>
#include <span>
#include <vector>

namespace relievo {

enum class DdsCode {
    bc1,  // colours, 8 bytes a block; alpha is lost
    bc3,  // colours and alpha, 16 bytes
    bc4,  // alpha alone, 8 bytes
};

// `faces`: one, or six in the order +x -x +y -y +z -z, of each its levels from the full size down, every one RGBA, rows top to bottom and
// half the size of the one before. The header is the one of 2000 with a four-letter code (DXT1, DXT5, ATI1), which more programs read than the
// DX10 one. The file appears whole or not at all. Throws Error. Does not depend on `threads`.
void write_dds(const std::filesystem::path& file, std::span<const std::vector<Image8>> faces, DdsCode code, int threads = 0);

}  // namespace relievo
