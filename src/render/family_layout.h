// What the programs of the height-field family bind: set 0 the maps, set 1 the scene (or, for casting, rays and hits), and the
// settings of a draw as push constants. One layout for all techniques, so that a material is bound once for all of them.
#pragma once

#include "gpu/device.h"
#include "render/shared_structs.h"

namespace relievo {

// After MarchParams in the same block (shaders/hosts/heightfield/family.glsl).
struct DrawUniforms {
    glsl::MarchParams march;
    glsl::ReliefUniforms relief;
    glsl::DrawNumbers numbers;
};
static_assert(offsetof(DrawUniforms, relief) == sizeof(glsl::MarchParams) &&
              offsetof(DrawUniforms, numbers) == sizeof(glsl::MarchParams) + sizeof(glsl::ReliefUniforms));
static_assert(sizeof(DrawUniforms) <= 128, "what every device takes as push constants");

struct FamilyLayout {
    explicit FamilyLayout(const gpu::Device& device);

    vk::raii::Sampler height_sampler;     // bilinear, one level
    vk::raii::Sampler trilinear_sampler;  // colour and normals
    vk::raii::Sampler nearest_sampler;    // the pyramid
    vk::raii::Sampler volume_sampler;     // trilinear, clamped in the third coordinate
    vk::raii::DescriptorSetLayout maps;
    vk::raii::DescriptorSetLayout scene;
    vk::raii::DescriptorSetLayout cast;
    vk::raii::PipelineLayout draw_pipeline;
    vk::raii::PipelineLayout cast_pipeline;
};

// A descriptor set with a pool of its own, freed with it.
struct DescriptorSet {
    vk::raii::DescriptorPool pool = nullptr;
    vk::DescriptorSet handle;
};
DescriptorSet make_descriptor_set(const gpu::Device& device, const vk::raii::DescriptorSetLayout& layout,
                                  std::initializer_list<vk::DescriptorPoolSize> sizes);

}  // namespace relievo
