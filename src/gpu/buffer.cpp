#include "gpu/buffer.h"

namespace relievo::gpu {

Buffer make_buffer(const Device& device, vk::DeviceSize size, vk::BufferUsageFlags usage) {
    Buffer buffer;
    buffer.size = size;
    buffer.handle = vk::raii::Buffer(device.handle(), vk::BufferCreateInfo{.size = size, .usage = usage});
    const auto needs = buffer.handle.getMemoryRequirements();
    constexpr auto coherent = vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
    std::uint32_t type = 0;
    try {
        type = device.memory_type(needs.memoryTypeBits, coherent | vk::MemoryPropertyFlagBits::eHostCached);
    } catch (const Error&) {
        type = device.memory_type(needs.memoryTypeBits, coherent);
    }
    buffer.memory =
        vk::raii::DeviceMemory(device.handle(), vk::MemoryAllocateInfo{.allocationSize = needs.size, .memoryTypeIndex = type});
    buffer.handle.bindMemory(*buffer.memory, 0);
    buffer.mapped = buffer.memory.mapMemory(0, VK_WHOLE_SIZE);
    return buffer;
}

}  // namespace relievo::gpu
