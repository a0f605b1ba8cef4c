#include "render/bake_program.h"

#include "core/error.h"
#include "gpu/pipeline.h"
#include "render/programs.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <string>
#include <vector>

namespace relievo {

BakeProgram::BakeProgram(const gpu::Device& device, std::string_view host, std::uint32_t buffers, std::uint32_t number_bytes)
    : device_(device), buffers_(buffers), number_bytes_(number_bytes) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (std::uint32_t b = 0; b < buffers; ++b)
        bindings.push_back({.binding = b,
                            .descriptorType = vk::DescriptorType::eStorageBuffer,
                            .descriptorCount = 1,
                            .stageFlags = vk::ShaderStageFlagBits::eCompute});
    set_layout_ = {device.handle(), vk::DescriptorSetLayoutCreateInfo{.bindingCount = buffers, .pBindings = bindings.data()}};
    const vk::PushConstantRange numbers{.stageFlags = vk::ShaderStageFlagBits::eCompute, .size = number_bytes};
    layout_ = {
        device.handle(),
        vk::PipelineLayoutCreateInfo{
            .setLayoutCount = 1, .pSetLayouts = &*set_layout_, .pushConstantRangeCount = 1, .pPushConstantRanges = &numbers}};
    pipeline_ = gpu::make_pipeline(device, *layout_, program_words(host));
}

DescriptorSet BakeProgram::bound(std::initializer_list<const gpu::Buffer*> buffers) const {
    assert(buffers.size() == buffers_);
    DescriptorSet set = make_descriptor_set(device_, set_layout_, {{vk::DescriptorType::eStorageBuffer, buffers_}});
    std::vector<vk::DescriptorBufferInfo> infos;
    for (const gpu::Buffer* buffer : buffers) infos.push_back({.buffer = *buffer->handle, .range = VK_WHOLE_SIZE});
    device_.handle().updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = set.handle,
                                                                 .descriptorCount = buffers_,
                                                                 .descriptorType = vk::DescriptorType::eStorageBuffer,
                                                                 .pBufferInfo = infos.data()},
                                          {});
    return set;
}

void upload(const gpu::Device& device, const void* data, std::size_t bytes, const gpu::Buffer& to) {
    const gpu::Buffer staging = gpu::make_buffer(device, bytes, vk::BufferUsageFlagBits::eTransferSrc);
    std::memcpy(staging.mapped, data, bytes);
    device.run([&](const vk::raii::CommandBuffer& commands) {
        commands.copyBuffer(*staging.handle, *to.handle, vk::BufferCopy{.size = bytes});
        gpu::full_barrier(commands);
    });
}

gpu::Buffer make_storage(const gpu::Device& device, std::size_t bytes, std::string_view map_id) {
    const std::size_t most = device.physical().getProperties().limits.maxStorageBufferRange;
    if (bytes > most)
        throw Error("bake", "the " + std::string(map_id) + " map on " + device.info().name,
                    "it would take a buffer of " + std::to_string(bytes >> 20) + " MB, and one of " + std::to_string(most >> 20) +
                        " MB is the largest there",
                    "bake it on the CPU (--device cpu), or a smaller field");
    return gpu::make_device_buffer(device, bytes, vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferDst);
}

}  // namespace relievo
