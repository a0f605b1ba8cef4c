#include "gpu/swapchain.h"

#include <algorithm>
#include <limits>

namespace relievo::gpu {

namespace {

constexpr auto forever = std::numeric_limits<std::uint64_t>::max();
constexpr const char* other_device =
    "choose another device with --device (relievo list devices); the software device shows on any display";

vk::SurfaceFormatKHR choose_format(const Device& device, vk::SurfaceKHR surface) {
    if (!device.physical().getSurfaceSupportKHR(device.queue_family(), surface))
        throw Error("open", "a window on " + device.info().name, "this device does not show pictures on this display",
                    other_device);
    for (const vk::SurfaceFormatKHR f : device.physical().getSurfaceFormatsKHR(surface))
        if ((f.format == vk::Format::eB8G8R8A8Unorm || f.format == vk::Format::eR8G8B8A8Unorm) &&
            f.colorSpace == vk::ColorSpaceKHR::eSrgbNonlinear)
            return f;
    throw Error("open", "a window on " + device.info().name, "the display takes no plain 8-bit pictures", other_device);
}

void image_barrier(const vk::raii::CommandBuffer& commands, vk::Image image, vk::ImageLayout from, vk::ImageLayout to) {
    const vk::ImageMemoryBarrier2 barrier{.srcStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                          .srcAccessMask = vk::AccessFlagBits2::eMemoryWrite,
                                          .dstStageMask = vk::PipelineStageFlagBits2::eAllCommands,
                                          .dstAccessMask = vk::AccessFlagBits2::eMemoryRead | vk::AccessFlagBits2::eMemoryWrite,
                                          .oldLayout = from,
                                          .newLayout = to,
                                          .srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                          .dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED,
                                          .image = image,
                                          .subresourceRange = {vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1}};
    commands.pipelineBarrier2({.imageMemoryBarrierCount = 1, .pImageMemoryBarriers = &barrier});
}

}  // namespace

Swapchain::Swapchain(const Device& device, vk::SurfaceKHR surface, vk::Extent2D wanted)
    : device_(device),
      surface_(surface),
      format_(choose_format(device, surface)),
      acquired_(device.handle(), vk::SemaphoreCreateInfo{}),
      done_(device.handle(), vk::FenceCreateInfo{.flags = vk::FenceCreateFlagBits::eSignaled}),
      pool_(device.handle(), vk::CommandPoolCreateInfo{.flags = vk::CommandPoolCreateFlagBits::eResetCommandBuffer,
                                                       .queueFamilyIndex = device.queue_family()}),
      commands_(device.handle(), vk::CommandBufferAllocateInfo{
                                     .commandPool = *pool_, .level = vk::CommandBufferLevel::ePrimary, .commandBufferCount = 1}) {
    rebuild(wanted);
}

Swapchain::~Swapchain() {
    // Semaphores may still be waited for by the screen. A lost device has nothing to wait for.
    try {
        device_.handle().waitIdle();
    } catch (const vk::SystemError&) {
    }
}

void Swapchain::rebuild(vk::Extent2D wanted) {
    device_.handle().waitIdle();
    const auto can = device_.physical().getSurfaceCapabilitiesKHR(surface_);
    // A surface without a size of its own says 2^32 - 1.
    extent_ = can.currentExtent.width != std::numeric_limits<std::uint32_t>::max()
                  ? can.currentExtent
                  : vk::Extent2D{std::clamp(wanted.width, can.minImageExtent.width, can.maxImageExtent.width),
                                 std::clamp(wanted.height, can.minImageExtent.height, can.maxImageExtent.height)};
    if (extent_.width == 0 || extent_.height == 0) {
        extent_ = vk::Extent2D{};
        return;
    }
    if (!(can.supportedUsageFlags & vk::ImageUsageFlagBits::eTransferDst))
        throw Error("open", "a window on " + device_.info().name, "its images cannot be copied to", other_device);
    const std::uint32_t count = std::max(2u, can.minImageCount);
    const vk::SwapchainCreateInfoKHR info{.surface = surface_,
                                          .minImageCount = can.maxImageCount > 0 ? std::min(count, can.maxImageCount) : count,
                                          .imageFormat = format_.format,
                                          .imageColorSpace = format_.colorSpace,
                                          .imageExtent = extent_,
                                          .imageArrayLayers = 1,
                                          .imageUsage = vk::ImageUsageFlagBits::eTransferDst,
                                          .imageSharingMode = vk::SharingMode::eExclusive,
                                          .preTransform = can.currentTransform,
                                          .compositeAlpha = (can.supportedCompositeAlpha & vk::CompositeAlphaFlagBitsKHR::eOpaque)
                                                                ? vk::CompositeAlphaFlagBitsKHR::eOpaque
                                                                : vk::CompositeAlphaFlagBitsKHR::eInherit,
                                          .presentMode = vk::PresentModeKHR::eFifo,  // the one mode every device has
                                          .clipped = true,
                                          .oldSwapchain = *swapchain_};
    swapchain_ = vk::raii::SwapchainKHR(device_.handle(), info);
    images_.clear();
    for (const auto image : swapchain_.getImages()) images_.emplace_back(image);
    drawn_.clear();
    for (std::size_t i = 0; i < images_.size(); ++i) drawn_.emplace_back(device_.handle(), vk::SemaphoreCreateInfo{});
}

void Swapchain::wait() const {
    const auto result = device_.handle().waitForFences(*done_, true, forever);
    if (result != vk::Result::eSuccess) throw Error("draw", "a frame on " + device_.info().name, vk::to_string(result));
}

bool Swapchain::show(const std::function<void(const vk::raii::CommandBuffer&, vk::Image)>& record) {
    wait();
    std::uint32_t index = 0;
    try {
        index = swapchain_.acquireNextImage(forever, *acquired_, nullptr).second;
    } catch (const vk::OutOfDateKHRError&) {
        return false;
    }
    const vk::raii::CommandBuffer& commands = commands_.front();
    commands.begin({.flags = vk::CommandBufferUsageFlagBits::eOneTimeSubmit});
    image_barrier(commands, images_[index], vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal);
    record(commands, images_[index]);
    image_barrier(commands, images_[index], vk::ImageLayout::eTransferDstOptimal, vk::ImageLayout::ePresentSrcKHR);
    commands.end();

    const vk::SemaphoreSubmitInfo ready{.semaphore = *acquired_, .stageMask = vk::PipelineStageFlagBits2::eAllCommands};
    const vk::SemaphoreSubmitInfo drawn{.semaphore = *drawn_[index], .stageMask = vk::PipelineStageFlagBits2::eAllCommands};
    const vk::CommandBufferSubmitInfo submitted{.commandBuffer = *commands};
    device_.handle().resetFences(*done_);
    device_.queue().submit2(vk::SubmitInfo2{.waitSemaphoreInfoCount = 1,
                                            .pWaitSemaphoreInfos = &ready,
                                            .commandBufferInfoCount = 1,
                                            .pCommandBufferInfos = &submitted,
                                            .signalSemaphoreInfoCount = 1,
                                            .pSignalSemaphoreInfos = &drawn},
                            *done_);
    try {
        const auto result = device_.queue().presentKHR({.waitSemaphoreCount = 1,
                                                        .pWaitSemaphores = &*drawn_[index],
                                                        .swapchainCount = 1,
                                                        .pSwapchains = &*swapchain_,
                                                        .pImageIndices = &index});
        return result == vk::Result::eSuccess;
    } catch (const vk::OutOfDateKHRError&) {
        return false;
    }
}

}  // namespace relievo::gpu
