// How many vertices the device computed for a part of a command buffer, by its own count.
#pragma once

#include "core/error.h"
#include "gpu/device.h"

#include <cassert>

namespace relievo::gpu {

// Only for devices that count vertices.
class VertexCounter {
public:
    explicit VertexCounter(const Device& device)
        : device_(device), query_(device.handle(), vk::QueryPoolCreateInfo{.queryType = vk::QueryType::ePipelineStatistics,
                                                                          .queryCount = 1,
                                                                          .pipelineStatistics = vk::QueryPipelineStatisticFlagBits::eVertexShaderInvocations}) {
        assert(device.counts_vertices());
    }

    void reset(const vk::raii::CommandBuffer& commands) const { commands.resetQueryPool(*query_, 0, 1); }  // outside of rendering
    void start(const vk::raii::CommandBuffer& commands) const { commands.beginQuery(*query_, 0, {}); }
    void stop(const vk::raii::CommandBuffer& commands) const { commands.endQuery(*query_, 0); }

    // After the commands have run.
    std::uint64_t invocations() const {
        const auto [result, count] = query_.getResult<std::uint64_t>(0, 1, sizeof(std::uint64_t), vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
        if (result != vk::Result::eSuccess) throw Error("count vertices", "on " + device_.info().name, vk::to_string(result));
        return count;
    }

private:
    const Device& device_;
    vk::raii::QueryPool query_;
};

}  // namespace relievo::gpu
