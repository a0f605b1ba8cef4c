// The window itself: GLFW, without any picture in it.
#pragma once

#include "gpu/device.h"

#include <memory>
#include <string>
#include <vector>

struct GLFWwindow;

namespace relievo {

class Window {
public:
    // Throws Error where there is no display, saying how to get one.
    Window(const std::string& title, int width, int height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    GLFWwindow* handle() const { return window_; }
    vk::Extent2D size_px() const;    // of the picture; zero while minimised
    float pixels_per_point() const;  // 2 where the display has two pixels to a unit of the mouse
    float text_scale() const;        // the display's own, 1 on ordinary ones
    bool closing() const;

    // Handles what has come; waits for something first, up to that long, if seconds > 0.
    void handle_events(double wait_seconds) const;

    static std::vector<const char*> instance_extensions();
    vk::raii::SurfaceKHR make_surface(const gpu::Device& device) const;

private:
    GLFWwindow* window_ = nullptr;
};

}  // namespace relievo
