// A Vulkan 1.3 device with one queue that draws and computes.
#pragma once

#include "core/error.h"
#include "gpu/vulkan.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace relievo::gpu {

struct DeviceInfo {
    std::string name;    // "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string driver;  // "llvmpipe Mesa 22.3.6 (LLVM 15.0.6), Vulkan 1.3.230"
    bool software;       // runs on the CPU
    bool usable;         // has what relievo needs
    std::string lacks;   // what it lacks if not
};

// Every Vulkan device of this machine, in the loader's order; none if there is no Vulkan at all.
std::vector<DeviceInfo> list_devices();

// The one that DeviceSettings::choice means. Throws Error where there is none.
DeviceInfo chosen_device(const std::string& choice);

class MessageLog;

struct DeviceSettings {
    std::string choice;       // "": the first real GPU, else a software device; "software"; or part of a name, in any case
    bool validation = false;  // collect the validation layers' messages, synchronisation included
    std::vector<const char*> instance_extensions = {};  // a window system's
    std::vector<const char*> device_extensions = {};    // VK_KHR_swapchain
};

class Device {
public:
    // Throws Error without a matching device (with the list of devices) or without the validation layer that was asked for.
    explicit Device(const DeviceSettings& settings);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const { return info_; }
    std::vector<std::string> validation_messages() const;

    const vk::raii::Instance& instance() const { return instance_; }
    const vk::raii::PhysicalDevice& physical() const { return physical_; }
    const vk::raii::Device& handle() const { return device_; }
    const vk::raii::Queue& queue() const { return queue_; }
    std::uint32_t queue_family() const { return queue_family_; }
    double nanoseconds_per_tick() const { return nanoseconds_per_tick_; }
    bool counts_vertices() const { return counts_vertices_; }  // has pipeline statistics
    bool has_wide_atomics() const { return has_wide_atomics_; }  // atomic minima of 64 bits in buffers

    // Records commands, runs them and waits for their end.
    void run(const std::function<void(const vk::raii::CommandBuffer&)>& record) const;

    // Index of a memory type among `allowed` that has all of `wanted`. Throws Error if there is none.
    std::uint32_t memory_type(std::uint32_t allowed, vk::MemoryPropertyFlags wanted) const;

private:
    std::unique_ptr<MessageLog> messages_;  // outlives the instance, which reports to it to the end
    std::optional<vk::raii::Context> context_;
    vk::raii::Instance instance_ = nullptr;
    vk::raii::DebugUtilsMessengerEXT messenger_ = nullptr;
    vk::raii::PhysicalDevice physical_ = nullptr;
    DeviceInfo info_;
    std::uint32_t queue_family_ = 0;
    double nanoseconds_per_tick_ = 1;
    bool counts_vertices_ = false, has_wide_atomics_ = false;
    vk::raii::Device device_ = nullptr;
    vk::raii::Queue queue_ = nullptr;
    vk::raii::CommandPool pool_ = nullptr;
};

// Makes all earlier writes visible to all later commands. Coarse on purpose: a picture has two or three passes.
void full_barrier(const vk::raii::CommandBuffer& commands);

// Runs f and turns what Vulkan throws into an Error about `attempt` on `subject`.
template <class F>
auto vulkan_errors_as(const std::string& attempt, const std::string& subject, F&& f) {
    try {
        return f();
    } catch (const vk::OutOfDeviceMemoryError& e) {
        throw Error(attempt, subject, e.what(), "use smaller maps or a smaller picture, or another device (--device)");
    } catch (const vk::DeviceLostError& e) {
        throw Error(attempt, subject, e.what(), "the driver gave up on a long draw: lower the step counts or the picture's size");
    } catch (const vk::SystemError& e) {
        throw Error(attempt, subject, e.what());
    }
}

}  // namespace relievo::gpu
