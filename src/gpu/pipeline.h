// Pipelines from SPIR-V: drawing into targets of given formats (dynamic rendering), and computing.
#pragma once

#include "gpu/device.h"

#include <cstdint>
#include <span>

namespace relievo::gpu {

struct DrawPipeline {
    std::span<const std::uint32_t> vertex;
    std::span<const std::uint32_t> fragment = {};  // empty: only depth is written
    std::span<const std::uint32_t> fragment_constants = {};  // specialization constants 0, 1, 2 ...: int, uint or bool
    std::span<const vk::Format> targets = {};
    std::span<const vk::VertexInputAttributeDescription> attributes = {};  // of binding 0; none: a strip made up by the vertex program
    std::uint32_t vertex_bytes = 0;                                        // of binding 0, which holds a list of triangles
    vk::Format depth = vk::Format::eUndefined;  // of a depth target that is tested (nearer wins) and written; undefined: there is none
    bool blended = false;  // over what is there, by the alpha of what is drawn; the target's alpha is then what has been covered,
                           // and what lies in one plane is drawn over each other, not once
};

vk::raii::Pipeline make_pipeline(const Device& device, vk::PipelineLayout layout, const DrawPipeline& settings);
// constants: specialization constants 0, 1, 2 ...
vk::raii::Pipeline make_pipeline(const Device& device, vk::PipelineLayout layout, std::span<const std::uint32_t> compute, std::span<const std::uint32_t> constants = {});

}  // namespace relievo::gpu
