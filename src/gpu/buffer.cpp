#include "gpu/buffer.h"

namespace relievo::gpu {

namespace {

Buffer unbound(const Device& device, vk::DeviceSize size, vk::BufferUsageFlags usage) {
    Buffer buffer;
    buffer.size = size;
    buffer.handle = vk::raii::Buffer(device.handle(), vk::BufferCreateInfo{.size = size, .usage = usage});
    return buffer;
}

void bind(const Device& device, Buffer& buffer, vk::DeviceSize bytes, std::uint32_t type) {
    buffer.memory = vk::raii::DeviceMemory(device.handle(), vk::MemoryAllocateInfo{.allocationSize = bytes, .memoryTypeIndex = type});
    buffer.handle.bindMemory(*buffer.memory, 0);
}

}  // namespace

Buffer make_buffer(const Device& device, vk::DeviceSize size, vk::BufferUsageFlags usage) {
    Buffer buffer = unbound(device, size, usage);
    const auto needs = buffer.handle.getMemoryRequirements();
    constexpr auto coherent = vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
    std::uint32_t type = 0;
    try {
        type = device.memory_type(needs.memoryTypeBits, coherent | vk::MemoryPropertyFlagBits::eHostCached);
    } catch (const Error&) {
        type = device.memory_type(needs.memoryTypeBits, coherent);
    }
    bind(device, buffer, needs.size, type);
    buffer.mapped = buffer.memory.mapMemory(0, VK_WHOLE_SIZE);
    return buffer;
}

Buffer make_device_buffer(const Device& device, vk::DeviceSize size, vk::BufferUsageFlags usage) {
    Buffer buffer = unbound(device, size, usage);
    const auto needs = buffer.handle.getMemoryRequirements();
    bind(device, buffer, needs.size, device.memory_type(needs.memoryTypeBits, vk::MemoryPropertyFlagBits::eDeviceLocal));
    return buffer;
}

}  // namespace relievo::gpu
