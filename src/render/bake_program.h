// A compute program of shaders/hosts/maps: storage buffers at bindings 0, 1, 2 ... of its only set, and a struct of push constants.
#pragma once

#include "gpu/buffer.h"
#include "render/family_layout.h"

#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace relievo {

class BakeProgram {
public:
    // number_bytes: of the push constants.
    BakeProgram(const gpu::Device& device, std::string_view host, std::uint32_t buffers, std::uint32_t number_bytes);

    // What a dispatch reads and writes, in the order of the bindings. To be kept until it has run.
    DescriptorSet bound(std::initializer_list<const gpu::Buffer*> buffers) const;

    // Later commands see what it writes.
    template <class Numbers>
    void dispatch(const vk::raii::CommandBuffer& commands, const DescriptorSet& set, const Numbers& numbers, std::uint32_t groups_x,
                  std::uint32_t groups_y = 1, std::uint32_t groups_z = 1) const {
        assert(sizeof numbers == number_bytes_);
        commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
        commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, set.handle, {});
        commands.pushConstants<Numbers>(*layout_, vk::ShaderStageFlagBits::eCompute, 0, numbers);
        commands.dispatch(groups_x, groups_y, groups_z);
        gpu::full_barrier(commands);
    }

private:
    const gpu::Device& device_;
    std::uint32_t buffers_, number_bytes_;
    vk::raii::DescriptorSetLayout set_layout_ = nullptr;
    vk::raii::PipelineLayout layout_ = nullptr;
    vk::raii::Pipeline pipeline_ = nullptr;
};

// What one dispatch of a bake does at most, in invocations: a dispatch then ends long before a driver gives the device up for hung,
// and whoever wants to stop waits no longer than that.
inline constexpr int most_invocations = 1 << 21;

// Copies `bytes` from the CPU into the device's own memory.
void upload(const gpu::Device& device, const void* data, std::size_t bytes, const gpu::Buffer& to);

// A buffer for programs alone. Throws Error where the device binds no buffer as large.
gpu::Buffer make_storage(const gpu::Device& device, std::size_t bytes, std::string_view map_id);

}  // namespace relievo
