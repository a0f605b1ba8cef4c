// Buffers: those the CPU sees all the time (uniforms, rays, results, staging), and those it never sees.
#pragma once

#include "gpu/device.h"

namespace relievo::gpu {

struct Buffer {
    vk::raii::DeviceMemory memory = nullptr;  // declared first: freed after the buffer
    vk::raii::Buffer handle = nullptr;
    vk::DeviceSize size = 0;
    void* mapped = nullptr;  // null: the CPU does not see it

    template <class T>
    T* as() const {
        return static_cast<T*>(mapped);
    }
};

// Host-coherent; cached where the device has that, because results are read back whole.
Buffer make_buffer(const Device& device, vk::DeviceSize size, vk::BufferUsageFlags usage);

// In the device's own memory, not mapped: what programs write for programs.
Buffer make_device_buffer(const Device& device, vk::DeviceSize size, vk::BufferUsageFlags usage);

}  // namespace relievo::gpu
