// The images of a window and their way to the screen. One frame is in flight at a time: what draws here is measured, not raced.
#pragma once

#include "gpu/device.h"

#include <functional>
#include <vector>

namespace relievo::gpu {

// What a device needs to show pictures: DeviceSettings::device_extensions.
inline constexpr const char* swapchain_extension = VK_KHR_SWAPCHAIN_EXTENSION_NAME;

class Swapchain {
public:
    // `surface` is of this device's instance and stays alive as long as this. Throws Error if the device cannot present to it.
    Swapchain(const Device& device, vk::SurfaceKHR surface, vk::Extent2D wanted);
    ~Swapchain();
    Swapchain(const Swapchain&) = delete;
    Swapchain& operator=(const Swapchain&) = delete;

    // Eight bits a channel without conversion, blue first or red first: the values written are the values shown, sRGB-encoded.
    vk::Format format() const { return format_.format; }
    // Zero while the window is minimised: there is nothing to show on.
    vk::Extent2D extent() const { return extent_; }

    // New images, after the window changed its size.
    void rebuild(vk::Extent2D wanted);

    // Until the frame before has been drawn: then what it read may be changed.
    void wait() const;

    // Waits, then records, draws and shows a frame. `record` finds the window's image in the layout transfer-destination and
    // leaves it there. False: the window has changed and this frame is not shown; rebuild and go on.
    bool show(const std::function<void(const vk::raii::CommandBuffer&, vk::Image)>& record);

private:
    const Device& device_;
    vk::SurfaceKHR surface_;
    vk::SurfaceFormatKHR format_;
    vk::Extent2D extent_;
    vk::raii::SwapchainKHR swapchain_ = nullptr;
    std::vector<vk::Image> images_;
    std::vector<vk::raii::Semaphore> drawn_;  // one an image: the screen may still wait for it when the next frame is drawn
    vk::raii::Semaphore acquired_;
    vk::raii::Fence done_;
    vk::raii::CommandPool pool_;
    vk::raii::CommandBuffers commands_;
};

}  // namespace relievo::gpu
