// A stage (camera, base, lights) in buffers the programs read. One frame at a time may be in flight per binding.
#pragma once

#include "core/vec.h"
#include "gpu/buffer.h"
#include "render/family_layout.h"
#include "scenes/scene.h"

namespace relievo {

class SceneBinding {
public:
    SceneBinding(const gpu::Device& device, const FamilyLayout& layout);

    // offset: of the sample inside its pixel, from the centre, in pixels.
    void update(const Stage& stage, int width, int height, Vec2f offset);

    vk::DescriptorSet set() const { return set_.handle; }
    std::uint32_t light_count() const { return light_count_; }
    float periods() const { return periods_; }
    bool from_behind() const { return from_behind_; }

private:
    const gpu::Device* device_;
    gpu::Buffer scene_;
    gpu::Buffer further_lights_;  // grows with the number of lights
    DescriptorSet set_;
    std::uint32_t light_count_ = 0;
    float periods_ = 0;
    bool from_behind_ = false;
};

}  // namespace relievo
