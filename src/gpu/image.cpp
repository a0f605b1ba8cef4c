#include "gpu/image.h"

#include <algorithm>

namespace relievo::gpu {

namespace {

// Enough that a band of a large map is worth a submission, little against the maps themselves.
constexpr std::size_t staging_bytes = std::size_t{8} << 20;

}  // namespace

Image make_image(const Device& device, vk::Format format, vk::Extent2D extent, std::uint32_t levels, vk::ImageUsageFlags usage,
                 std::uint32_t layers) {
    Image image;
    image.format = format;
    image.extent = extent;
    image.levels = levels;
    const bool cube = layers == cube_layers;
    image.layers = cube ? 6 : std::max(1u, layers);
    if (usage & vk::ImageUsageFlagBits::eDepthStencilAttachment) image.aspect = vk::ImageAspectFlagBits::eDepth;
    image.handle = vk::raii::Image(device.handle(), vk::ImageCreateInfo{.flags = cube ? vk::ImageCreateFlagBits::eCubeCompatible : vk::ImageCreateFlags{},
                                                                        .imageType = vk::ImageType::e2D,
                                                                        .format = format,
                                                                        .extent = {extent.width, extent.height, 1},
                                                                        .mipLevels = levels,
                                                                        .arrayLayers = image.layers,
                                                                        .samples = vk::SampleCountFlagBits::e1,
                                                                        .tiling = vk::ImageTiling::eOptimal,
                                                                        .usage = usage,
                                                                        .initialLayout = vk::ImageLayout::eUndefined});
    const auto needs = image.handle.getMemoryRequirements();
    image.memory = vk::raii::DeviceMemory(
        device.handle(), vk::MemoryAllocateInfo{.allocationSize = needs.size,
                                                .memoryTypeIndex = device.memory_type(needs.memoryTypeBits,
                                                                                      vk::MemoryPropertyFlagBits::eDeviceLocal)});
    image.handle.bindMemory(*image.memory, 0);
    image.view = vk::raii::ImageView(
        device.handle(), vk::ImageViewCreateInfo{.image = *image.handle,
                                                 .viewType = cube          ? vk::ImageViewType::eCube
                                                             : layers == 0 ? vk::ImageViewType::e2D
                                                                           : vk::ImageViewType::e2DArray,
                                                 .format = format,
                                                 .subresourceRange = {image.aspect, 0, levels, 0, image.layers}});
    return image;
}

void transition(const vk::raii::CommandBuffer& commands, const Image& image, vk::ImageLayout from, vk::ImageLayout to) {
    const vk::ImageMemoryBarrier2 barrier{.srcStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                          .srcAccessMask = vk::AccessFlagBits2::eMemoryWrite,
                                          .dstStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                          .dstAccessMask = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite,
                                          .oldLayout = from,
                                          .newLayout = to,
                                          .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                          .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                          .image = *image.handle,
                                          .subresourceRange = {image.aspect, 0, image.levels, 0, image.layers}};
    commands.pipelineBarrier2({.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier});
}

Image make_texture(const Device& device, vk::Format format, vk::Extent2D extent, std::uint32_t levels, std::size_t bytes_per_texel,
                   const WriteRow& write_row, std::uint32_t layers) {
    Image image =
        make_image(device, format, extent, levels,
                   vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst | vk::ImageUsageFlagBits::eTransferSrc,
                   layers);
    const Buffer staging =
        make_buffer(device, std::max(staging_bytes, extent.width * bytes_per_texel), vk::BufferUsageFlagBits::eTransferSrc);
    device.run([&](const vk::raii::CommandBuffer& commands) {
        transition(commands, image, vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal);
    });
    for (std::uint32_t level = 0; level < levels; ++level) {
        const std::uint32_t width = std::max(1u, extent.width >> level);
        const std::uint32_t height = std::max(1u, extent.height >> level);
        const std::size_t row_bytes = width * bytes_per_texel;
        const auto band = static_cast<std::uint32_t>(std::min<std::size_t>(height, staging.size / row_bytes));
        for (std::uint32_t first = 0; first < height * image.layers; first += std::min(band, height - first % height)) {
            const std::uint32_t y = first % height;
            const std::uint32_t rows = std::min(band, height - y);
            for (std::uint32_t r = 0; r < rows; ++r)
                write_row(static_cast<int>(level), static_cast<int>(first + r), staging.as<std::byte>() + r * row_bytes);
            device.run([&](const vk::raii::CommandBuffer& commands) {
                const vk::BufferImageCopy region{.imageSubresource = {vk::ImageAspectFlagBits::eColor, level, first / height, 1},
                                                 .imageOffset = {0, static_cast<std::int32_t>(y), 0},
                                                 .imageExtent = {width, rows, 1}};
                commands.copyBufferToImage(*staging.handle, *image.handle, vk::ImageLayout::eTransferDstOptimal, region);
            });
        }
    }
    device.run([&](const vk::raii::CommandBuffer& commands) {
        transition(commands, image, vk::ImageLayout::eTransferDstOptimal, vk::ImageLayout::eShaderReadOnlyOptimal);
    });
    return image;
}

void read_back(const vk::raii::CommandBuffer& commands, const Image& image, const Buffer& to, std::uint32_t level) {
    const vk::BufferImageCopy region{
        .imageSubresource = {vk::ImageAspectFlagBits::eColor, level, 0, 1},
        .imageExtent = {std::max(1u, image.extent.width >> level), std::max(1u, image.extent.height >> level), 1}};
    commands.copyImageToBuffer(*image.handle, vk::ImageLayout::eTransferSrcOptimal, *to.handle, region);
    full_barrier(commands);
}

}  // namespace relievo::gpu
