// Three-dimensional textures on the device.
#pragma once

#include "gpu/image.h"

namespace relievo::gpu {

// A sampled volume of one level, filled row by row: `write_row` is given the slice as its level. The image's extent is a slice's; it
// ends in the layout shader-read-only.
Image make_volume(const Device& device, vk::Format format, vk::Extent3D extent, std::size_t bytes_per_texel, const WriteRow& write_row);

}  // namespace relievo::gpu
