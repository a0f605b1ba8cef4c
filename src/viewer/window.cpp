#include "viewer/window.h"

// Before GLFW, which then declares its Vulkan functions.
#include <GLFW/glfw3.h>

#include <algorithm>

namespace relievo {

namespace {

[[noreturn]] void throw_glfw_error(const std::string& advice) {
    const char* text = nullptr;
    glfwGetError(&text);
    throw Error("open", "a window", text != nullptr ? text : "GLFW gives no reason", advice);
}

constexpr const char* virtual_display =
    "Run it where there is a display, or on a virtual one: xvfb-run -a relievo view ... (package xvfb).\n"
    "  Pictures without a window: relievo render, relievo compare.";

}  // namespace

Window::Window(const std::string& title, int width, int height) {
    if (glfwInit() == GLFW_FALSE) throw_glfw_error(virtual_display);
    const auto give_up = [](const std::string& advice) {
        // The text belongs to GLFW, so it is read before GLFW ends.
        try {
            throw_glfw_error(advice);
        } catch (...) {
            glfwTerminate();
            throw;
        }
    };
    if (glfwVulkanSupported() == GLFW_FALSE) {
        glfwTerminate();
        throw Error("open", "a window", "no Vulkan driver here shows pictures on this display",
                    "install a Vulkan driver; Mesa's software device (mesa-vulkan-drivers) runs on any machine");
    }
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) give_up(virtual_display);
    glfwSetInputMode(window_, GLFW_STICKY_KEYS, GLFW_TRUE);  // a key pressed and released between two frames is not lost
}

Window::~Window() {
    glfwDestroyWindow(window_);
    glfwTerminate();
}

vk::Extent2D Window::size_px() const {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
}

float Window::pixels_per_point() const {
    int width = 0, height = 0;
    glfwGetWindowSize(window_, &width, &height);
    return width > 0 ? static_cast<float>(size_px().width) / static_cast<float>(width) : 1.0f;
}

float Window::text_scale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    // Displays that already count in larger units must not be enlarged twice.
    return std::clamp(x / pixels_per_point(), 1.0f, 4.0f);
}

bool Window::closing() const { return glfwWindowShouldClose(window_) == GLFW_TRUE; }

void Window::handle_events(double wait_seconds) const {
    if (wait_seconds > 0) {
        glfwWaitEventsTimeout(wait_seconds);
    } else {
        glfwPollEvents();
    }
}

std::vector<const char*> Window::instance_extensions() {
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    return {names, names + count};
}

vk::raii::SurfaceKHR Window::make_surface(const gpu::Device& device) const {
    VkSurfaceKHR surface = VK_NULL_HANDLE;
    if (glfwCreateWindowSurface(*device.instance(), window_, nullptr, &surface) != VK_SUCCESS)
        throw_glfw_error("choose another device with --device (relievo list devices)");
    return {device.instance(), surface};
}

}  // namespace relievo
