// A window's images, one frame in flight. The window system is the caller's: it makes the surface and names its extensions
// (DeviceSettings).
#pragma once

#include "gpu/device.h"

#include <functional>
#include <vector>

namespace relievo::gpu {

class Swapchain {
public:
    // surface: a VkSurfaceKHR of device.instance(), owned from here on. Throws Error if the device cannot present to it.
    Swapchain(const Device& device, VkSurfaceKHR surface, vk::Extent2D extent);
    ~Swapchain();

    struct Target {
        vk::Image image;
        vk::ImageView view;
        vk::Extent2D extent;
        std::uint32_t index;
    };

    // Shows one frame: `record` draws into an image that is in the layout colour-attachment and leaves it there. Waits for the
    // frame to be drawn. False if the window has changed size and the frame was not shown: call resize and draw again.
    bool show(const std::function<void(const vk::raii::CommandBuffer&, const Target&)>& record);

    void resize(vk::Extent2D extent);

    vk::Format format() const { return format_.format; }
    vk::Extent2D extent() const { return extent_; }
    std::uint32_t image_count() const { return static_cast<std::uint32_t>(images_.size()); }

private:
    const Device& device_;
    vk::raii::SurfaceKHR surface_;
    vk::SurfaceFormatKHR format_;
    vk::Extent2D extent_;
    vk::raii::SwapchainKHR swapchain_ = nullptr;
    std::vector<vk::Image> images_;
    std::vector<vk::raii::ImageView> views_;
    vk::raii::CommandPool pool_;
    vk::raii::CommandBuffer commands_ = nullptr;
    vk::raii::Semaphore acquired_;
    std::vector<vk::raii::Semaphore> drawn_;  // one per image: presentation of an older frame may still wait for its own
    vk::raii::Fence done_;
};

}  // namespace relievo::gpu
