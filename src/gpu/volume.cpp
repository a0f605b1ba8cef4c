#include "gpu/volume.h"

#include <algorithm>

namespace relievo::gpu {

Image make_volume(const Device& device, vk::Format format, vk::Extent3D extent, std::size_t bytes_per_texel, const WriteRow& write_row) {
    Image image;
    image.format = format;
    image.extent = vk::Extent2D{extent.width, extent.height};
    image.handle = vk::raii::Image(device.handle(), vk::ImageCreateInfo{.imageType = vk::ImageType::e3D,
                                                                        .format = format,
                                                                        .extent = extent,
                                                                        .mipLevels = 1,
                                                                        .arrayLayers = 1,
                                                                        .samples = vk::SampleCountFlagBits::e1,
                                                                        .tiling = vk::ImageTiling::eOptimal,
                                                                        .usage = vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst,
                                                                        .initialLayout = vk::ImageLayout::eUndefined});
    const auto needs = image.handle.getMemoryRequirements();
    image.memory = vk::raii::DeviceMemory(
        device.handle(),
        vk::MemoryAllocateInfo{.allocationSize = needs.size,
                               .memoryTypeIndex = device.memory_type(needs.memoryTypeBits, vk::MemoryPropertyFlagBits::eDeviceLocal)});
    image.handle.bindMemory(*image.memory, 0);
    image.view = vk::raii::ImageView(device.handle(),
                                     vk::ImageViewCreateInfo{.image = *image.handle,
                                                             .viewType = vk::ImageViewType::e3D,
                                                             .format = format,
                                                             .subresourceRange = {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}});

    // A few slices at a time, so that the map is never held twice.
    const std::size_t slice_bytes = std::size_t{extent.width} * extent.height * bytes_per_texel;
    const auto band = static_cast<std::uint32_t>(std::clamp<std::size_t>((std::size_t{8} << 20) / slice_bytes, 1, extent.depth));
    const Buffer staging = make_buffer(device, band * slice_bytes, vk::BufferUsageFlagBits::eTransferSrc);
    device.run([&](const vk::raii::CommandBuffer& commands) {
        transition(commands, image, vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal);
    });
    for (std::uint32_t z = 0; z < extent.depth; z += band) {
        const std::uint32_t slices = std::min(band, extent.depth - z);
        for (std::uint32_t k = 0; k < slices; ++k)
            for (std::uint32_t y = 0; y < extent.height; ++y)
                write_row(static_cast<int>(z + k), static_cast<int>(y),
                          staging.as<std::byte>() + (std::size_t{k} * extent.height + y) * extent.width * bytes_per_texel);
        device.run([&](const vk::raii::CommandBuffer& commands) {
            const vk::BufferImageCopy region{.imageSubresource = {vk::ImageAspectFlagBits::eColor, 0, 0, 1},
                                             .imageOffset = {0, 0, static_cast<std::int32_t>(z)},
                                             .imageExtent = {extent.width, extent.height, slices}};
            commands.copyBufferToImage(*staging.handle, *image.handle, vk::ImageLayout::eTransferDstOptimal, region);
        });
    }
    device.run([&](const vk::raii::CommandBuffer& commands) {
        transition(commands, image, vk::ImageLayout::eTransferDstOptimal, vk::ImageLayout::eShaderReadOnlyOptimal);
    });
    return image;
}

}  // namespace relievo::gpu
