// Small materials on disk, whole and spoiled.
#pragma once

#include "assets/image_file.h"

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

namespace relievo::test {

// Waves that repeat: height = 1/2 + 0.3 sin(u) cos(2v), in [0.2, 0.8].
inline ImageF wave_heights(int width, int height) {
    ImageF image(width, height, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image(x, y) = static_cast<float>(0.5 + 0.3 * std::sin(2 * std::numbers::pi * x / width) * std::cos(4 * std::numbers::pi * y / height));
    return image;
}

// The normals of those waves at this height_scale, stored as n/2 + 1/2.
inline ImageF wave_normals(int width, int height, double height_scale) {
    ImageF image(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double u = 2 * std::numbers::pi * x / width, v = 4 * std::numbers::pi * y / height;
            const double nx = -height_scale * 0.3 * 2 * std::numbers::pi * std::cos(u) * std::cos(v);
            const double ny = height_scale * 0.3 * 4 * std::numbers::pi * std::sin(u) * std::sin(v);
            const double length = std::sqrt(nx * nx + ny * ny + 1);
            image(x, y, 0) = static_cast<float>(nx / length / 2 + 0.5);
            image(x, y, 1) = static_cast<float>(ny / length / 2 + 0.5);
            image(x, y, 2) = static_cast<float>(1 / length / 2 + 0.5);
        }
    return image;
}

inline Image8 colour_stripes(int width, int height) {
    Image8 image(width, height, 3);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            image(x, y, 0) = static_cast<std::uint8_t>(255 * x / width);
            image(x, y, 1) = static_cast<std::uint8_t>(255 * y / height);
            image(x, y, 2) = 60;
        }
    return image;
}

// A folder with wave_height.png (16 bit) and wave_colour.png; returns its path.
inline std::string wave_folder(const std::filesystem::path& folder, int width = 32, int height = 32) {
    std::filesystem::create_directories(folder);
    write_png_16(folder / "wave_height.png", wave_heights(width, height), FirstRow::bottom);
    write_png(folder / "wave_colour.png", colour_stripes(width, height), FirstRow::bottom);
    return folder.string();
}

// One channel of heights as float EXR, for values that no PNG holds.
inline void write_float_heights(const std::filesystem::path& file, const ImageF& heights) {
    const ExrChannel channel[] = {{"Y", &heights, 0}};
    write_exr(file, channel, FirstRow::bottom);
}

}  // namespace relievo::test
