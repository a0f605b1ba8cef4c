// Dear ImGui over an image: its context, its style, and the render pass that the packaged Vulkan backend asks for.
#pragma once

#include "gpu/device.h"
#include "gpu/image.h"
#include "viewer/window.h"

struct ImFont;

namespace relievo {

class UiLayer {
public:
    // Draws into images of this format, over what is there. The values drawn are sRGB-encoded, so the format converts nothing.
    UiLayer(const Window& window, const gpu::Device& device, vk::Format format);
    ~UiLayer();
    UiLayer(const UiLayer&) = delete;
    UiLayer& operator=(const UiLayer&) = delete;

    // The image drawn on from now on; it lives until the next one is set.
    void set_target(const gpu::Image& image);

    void begin_frame() const;  // then ImGui calls
    void end_frame() const;
    // What end_frame completed, over the target, which is in the layout colour-attachment and stays there.
    void record(const vk::raii::CommandBuffer& commands) const;

    ImFont* heading() const { return heading_; }

private:
    void hold_short_presses() const;

    GLFWwindow* window_;
    const gpu::Device& device_;
    vk::raii::RenderPass pass_ = nullptr;
    vk::raii::DescriptorPool descriptors_ = nullptr;
    vk::raii::Framebuffer framebuffer_ = nullptr;
    vk::Extent2D extent_;
    ImFont* heading_ = nullptr;
};

}  // namespace relievo
