// How long the device worked on a part of a command buffer.
#pragma once

#include "core/error.h"
#include "gpu/device.h"

namespace relievo::gpu {

class Stopwatch {
public:
    explicit Stopwatch(const Device& device)
        : device_(device),
          stamps_(device.handle(), vk::QueryPoolCreateInfo{.queryType = vk::QueryType::eTimestamp, .queryCount = 2}) {}

    // Between them stands what is measured, with everything before it finished.
    void start(const vk::raii::CommandBuffer& commands) const {
        commands.resetQueryPool(*stamps_, 0, 2);
        commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *stamps_, 0);
    }
    void stop(const vk::raii::CommandBuffer& commands) const {
        commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *stamps_, 1);
    }

    // After the commands have run.
    double elapsed_ms() const {
        const auto [result, ticks] = stamps_.getResults<std::uint64_t>(
            0, 2, 2 * sizeof(std::uint64_t), sizeof(std::uint64_t), vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
        if (result != vk::Result::eSuccess) throw Error("time", "a pass on " + device_.info().name, vk::to_string(result));
        return static_cast<double>(ticks[1] - ticks[0]) * device_.nanoseconds_per_tick() * 1e-6;
    }

private:
    const Device& device_;
    vk::raii::QueryPool stamps_;
};

}  // namespace relievo::gpu
