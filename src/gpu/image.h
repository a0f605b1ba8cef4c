// Two-dimensional images on the device: textures with given mip chains, and targets that are drawn to and read back.
#pragma once

#include "gpu/buffer.h"

#include <cstddef>
#include <functional>
#include <span>

namespace relievo::gpu {

struct Image {
    vk::raii::DeviceMemory memory = nullptr;
    vk::raii::Image handle = nullptr;
    vk::raii::ImageView view = nullptr;  // all levels
    vk::Format format = vk::Format::eUndefined;
    vk::Extent2D extent;
    std::uint32_t levels = 1;
    std::uint32_t layers = 1;
    vk::ImageAspectFlags aspect = vk::ImageAspectFlagBits::eColor;  // depth for depth formats
};

// layers: 0 for a plain image, else of an array; cube_layers for a cube, its faces in the order +x -x +y -y +z -z.
inline constexpr std::uint32_t cube_layers = ~0u;
Image make_image(const Device& device, vk::Format format, vk::Extent2D extent, std::uint32_t levels, vk::ImageUsageFlags usage,
                 std::uint32_t layers = 0);

void transition(const vk::raii::CommandBuffer& commands, const Image& image, vk::ImageLayout from, vk::ImageLayout to);

// Writes row `y` of `level` as texels of the image's format to `out`; in an array the rows of a level go on from layer to layer.
using WriteRow = std::function<void(int level, int y, std::byte* out)>;

// A sampled image whose level k has extent >> k (at least 1), filled row by row. Rows travel through a small staging buffer, so
// that a large map is never held twice. The image ends in the layout shader-read-only.
Image make_texture(const Device& device, vk::Format format, vk::Extent2D extent, std::uint32_t levels, std::size_t bytes_per_texel,
                   const WriteRow& write_row, std::uint32_t layers = 0);

// Reads a level of an image that is in the layout transfer-source: rows top to bottom, texels tightly packed, into a buffer of that
// size.
void read_back(const vk::raii::CommandBuffer& commands, const Image& image, const Buffer& to, std::uint32_t level = 0);

}  // namespace relievo::gpu
