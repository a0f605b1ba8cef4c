// Pipelines from SPIR-V: drawing into targets of given formats (dynamic rendering, no blending, no depth), and computing.
#pragma once

#include "gpu/device.h"

#include <cstdint>
#include <span>

namespace relievo::gpu {

struct DrawPipeline {
    std::span<const std::uint32_t> vertex;
    std::span<const std::uint32_t> fragment;
    std::span<const std::uint32_t> fragment_constants;  // specialization constants 0, 1, 2 ...: int, uint or bool
    std::span<const vk::Format> targets;
};

vk::raii::Pipeline make_pipeline(const Device& device, vk::PipelineLayout layout, const DrawPipeline& settings);
vk::raii::Pipeline make_pipeline(const Device& device, vk::PipelineLayout layout, std::span<const std::uint32_t> compute);

}  // namespace relievo::gpu
