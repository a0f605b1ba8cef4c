#include "gpu/swapchain.h"

#include <algorithm>
#include <limits>

namespace relievo::gpu {

namespace {

// Pictures are linear until the image encodes them, so an sRGB format comes first; any other will do if there is none.
vk::SurfaceFormatKHR choose_format(const vk::raii::PhysicalDevice& physical, vk::SurfaceKHR surface) {
    const auto formats = physical.getSurfaceFormatsKHR(surface);
    const auto it = std::ranges::find_if(formats, [](const vk::SurfaceFormatKHR& f) {
        return f.format == vk::Format::eB8G8R8A8Srgb || f.format == vk::Format::eR8G8B8A8Srgb;
    });
    return it == formats.end() ? formats.front() : *it;
}

void image_barrier(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageLayout from, vk::ImageLayout to) {
    const vk::ImageMemoryBarrier2 barrier{
        .srcStageMask = vk::PipelineStageFlagBits2::eColorAttachmentOutput,
        .srcAccessMask = vk::AccessFlagBits2::eColorAttachmentWrite,
        .dstStageMask = vk::PipelineStageFlagBits2::eColorAttachmentOutput,
        .dstAccessMask = vk::AccessFlagBits2::eColorAttachmentWrite | vk::AccessFlagBits2::eColorAttachmentRead,
        .oldLayout = from,
        .newLayout = to,
        .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
        .image = image,
        .subresourceRange = {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}};
    commands.pipelineBarrier2({.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier});
}

}  // namespace

Swapchain::Swapchain(const Device& device, VkSurfaceKHR surface, vk::Extent2D extent)
    : device_(device),
      surface_(device.instance(), surface),
      pool_(device.handle(), vk::CommandPoolCreateInfo{.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                                       .queueFamilyIndex = device.queue_family()}),
      acquired_(device.handle(), vk::SemaphoreCreateInfo{}),
      done_(device.handle(), vk::FenceCreateInfo{}) {
    if (!device.physical().getSurfaceSupportKHR(device.queue_family(), *surface_))
        throw Error("show", "a window", device.info().name + " cannot present to it", "choose another device (--device)");
    format_ = choose_format(device.physical(), *surface_);
    commands_ =
        std::move(vk::raii::CommandBuffers(
                      device.handle(), {.commandPool = *pool_, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1})
                      .front());
    resize(extent);
}

Swapchain::~Swapchain() {
    try {
        device_.handle().waitIdle();
    } catch (const vk::SystemError&) {
        // A lost device has nothing left to wait for.
    }
}

void Swapchain::resize(vk::Extent2D extent) {
    device_.handle().waitIdle();
    const auto can = device_.physical().getSurfaceCapabilitiesKHR(*surface_);
    // Most window systems fix the extent; the others let us choose.
    if (can.currentExtent.width != std::numeric_limits<std::uint32_t>::max()) extent = can.currentExtent;
    extent_ = vk::Extent2D{std::clamp(extent.width, can.minImageExtent.width, can.maxImageExtent.width),
                           std::clamp(extent.height, can.minImageExtent.height, can.maxImageExtent.height)};
    const std::uint32_t most = can.maxImageCount == 0 ? std::numeric_limits<std::uint32_t>::max() : can.maxImageCount;
    views_.clear();
    drawn_.clear();
    vk::raii::SwapchainKHR next(device_.handle(),
                                vk::SwapchainCreateInfoKHR{.surface = *surface_,
                                                           .minImageCount = std::min(can.minImageCount + 1, most),
                                                           .imageFormat = format_.format,
                                                           .imageColorSpace = format_.colorSpace,
                                                           .imageExtent = extent_,
                                                           .imageArrayLayers = 1,
                                                           .imageUsage = vk::ImageUsageFlagBits::eColorAttachment,
                                                           .imageSharingMode = vk::SharingMode::eExclusive,
                                                           .preTransform = can.currentTransform,
                                                           .compositeAlpha = vk::CompositeAlphaFlagBitsKHR::eOpaque,
                                                           .presentMode = vk::PresentModeKHR::eFifo,  // the one every device has
                                                           .clipped = true,
                                                           .oldSwapchain = *swapchain_});
    swapchain_ = std::move(next);
    images_.clear();
    for (const auto image : swapchain_.getImages()) {
        images_.push_back(vk::Image(image));
        views_.emplace_back(device_.handle(),
                            vk::ImageViewCreateInfo{.image = vk::Image(image),
                                                    .viewType = vk::ImageViewType::e2D,
                                                    .format = format_.format,
                                                    .subresourceRange = {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}});
        drawn_.emplace_back(device_.handle(), vk::SemaphoreCreateInfo{});
    }
}

bool Swapchain::show(const std::function<void(const vk::raii::CommandBuffer&, const Target&)>& record) {
    constexpr auto forever = std::numeric_limits<std::uint64_t>::max();
    std::uint32_t index = 0;
    try {
        // "Suboptimal" still shows; only "out of date", which throws, does not.
        index = swapchain_.acquireNextImage(forever, *acquired_, nullptr).second;
    } catch (const vk::OutOfDateKHRError&) {
        return false;
    }
    commands_.reset();
    commands_.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    image_barrier(commands_, images_[index], vk::ImageLayout::eUndefined, vk::ImageLayout::eColorAttachmentOptimal);
    record(commands_, {images_[index], *views_[index], extent_, index});
    image_barrier(commands_, images_[index], vk::ImageLayout::eColorAttachmentOptimal, vk::ImageLayout::ePresentSrcKHR);
    commands_.end();

    const vk::SemaphoreSubmitInfo wait{.semaphore = *acquired_, .stageMask = vk::PipelineStageFlagBits2::eColorAttachmentOutput};
    const vk::SemaphoreSubmitInfo signal{.semaphore = *drawn_[index], .stageMask = vk::PipelineStageFlagBits2::eAllCommands};
    const vk::CommandBufferSubmitInfo submitted{.commandBuffer = *commands_};
    device_.queue().submit2(vk::SubmitInfo2{.waitSemaphoreInfoCount = 1,
                                            .pWaitSemaphoreInfos = &wait,
                                            .commandBufferInfoCount = 1,
                                            .pCommandBufferInfos = &submitted,
                                            .signalSemaphoreInfoCount = 1,
                                            .pSignalSemaphoreInfos = &signal},
                            *done_);
    const auto result = device_.handle().waitForFences(*done_, true, forever);
    if (result != vk::Result::eSuccess) throw Error("show", "a frame on " + device_.info().name, vk::to_string(result));
    device_.handle().resetFences(*done_);

    const vk::Semaphore drawn = *drawn_[index];
    const vk::SwapchainKHR chain = *swapchain_;
    try {
        return device_.queue().presentKHR({.waitSemaphoreCount = 1,
                                           .pWaitSemaphores = &drawn,
                                           .swapchainCount = 1,
                                           .pSwapchains = &chain,
                                           .pImageIndices = &index}) == vk::Result::eSuccess;
    } catch (const vk::OutOfDateKHRError&) {
        return false;
    }
}

}  // namespace relievo::gpu
