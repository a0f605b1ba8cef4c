// Picture files <-> Image, through OpenImageIO. Nothing here knows what a picture means.
#pragma once

#include "core/image.h"

#include <filesystem>
#include <span>
#include <string>

namespace relievo {

// Which row of a picture lies first in memory: the bottom for maps (v = 0), the top for frames.
enum class FirstRow { bottom, top };

// What a picture file holds before any of its texels is decoded.
struct ImageFileInfo {
    int width = 0;
    int height = 0;
    int channels = 0;       // 1 grey, 2 grey + alpha (or two data channels), 3 RGB, 4 RGBA, more in EXR; palettes count as expanded
    int bits = 0;           // per channel as stored: 8, 16, 32; a palette's entries have 8
    bool floating = false;  // half or float: values are not confined to [0,1], and a colour is linear
    std::string format;     // "png", "jpeg", ...
};

// Longest side and largest number of texels that are read: beyond them a file is taken for damaged or hostile rather than
// allocated. 16384^2 is what Vulkan devices take at most; as RGBA floats it is already 4 GiB.
inline constexpr int max_image_side = 32768;
inline constexpr long long max_image_texels = 16384LL * 16384LL;

// PNG, JPEG, TGA, OpenEXR, TIFF, Radiance HDR, DDS, BMP and WebP, told by their first bytes (TGA, which has none, by its name);
// 8, 16 or 32 bits, palettes expanded, alpha not premultiplied. Throws Error naming file and reason for anything else: missing,
// empty, damaged, truncated, too large, cube maps, volumes and deep images.
ImageFileInfo read_image_info(const std::filesystem::path& file);

// All channels. Integers become value / (2^bits - 1) exactly, floats stay as they are (NaN included).
ImageF read_image(const std::filesystem::path& file, FirstRow first_row = FirstRow::bottom);

// All channels in 8 bits: 8-bit files unchanged, 16-bit ones rounded. For floating files the values are taken for linear light
// and sRGB-encoded (alpha is not).
Image8 read_image_8(const std::filesystem::path& file, FirstRow first_row = FirstRow::bottom);

// The sRGB transfer function (IEC 61966-2-1) of linear light, clamped to [0,1], in 8 bits, rounded to nearest. NaN gives 0.
std::uint8_t srgb_from_linear(float linear);

// Writers: the file appears whole or not at all (atomic_file.h); Error if it cannot be written.
// 8 bits per channel, 1 to 4 channels, the values as they are (sRGB-encoded for colours).
void write_png(const std::filesystem::path& file, const Image8& image, FirstRow first_row);
// 16 bits per channel, 1 to 4 channels; values in [0,1] become round(65535 x), others are clamped, NaN gives 0.
void write_png_16(const std::filesystem::path& file, const ImageF& image, FirstRow first_row);

// One plane of an EXR: a name ("R", "hit.U") and one channel of an image; all planes of a file have one size.
struct ExrChannel {
    std::string name;
    const ImageF* image = nullptr;
    int channel = 0;
};
// 32-bit floats, ZIP-compressed (lossless).
void write_exr(const std::filesystem::path& file, std::span<const ExrChannel> channels, FirstRow first_row);

}  // namespace relievo
