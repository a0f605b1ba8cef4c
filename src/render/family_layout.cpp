#include "render/family_layout.h"

#include "core/map_set.h"

#include <array>
#include <span>
#include <vector>

namespace relievo {

namespace {

vk::raii::Sampler sampler(const gpu::Device& device, vk::Filter filter, vk::SamplerMipmapMode mipmaps,
                          vk::SamplerAddressMode upward = vk::SamplerAddressMode::eRepeat) {
    return {device.handle(), vk::SamplerCreateInfo{.magFilter = filter,
                                                   .minFilter = filter,
                                                   .mipmapMode = mipmaps,
                                                   .addressModeU = vk::SamplerAddressMode::eRepeat,
                                                   .addressModeV = vk::SamplerAddressMode::eRepeat,
                                                   .addressModeW = upward,
                                                   .maxLod = VK_LOD_CLAMP_NONE}};
}

vk::raii::DescriptorSetLayout set_layout(const gpu::Device& device, std::span<const vk::DescriptorType> types,
                                         vk::ShaderStageFlags stages) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (const vk::DescriptorType type : types)
        bindings.push_back({.binding = static_cast<std::uint32_t>(bindings.size()),
                            .descriptorType = type,
                            .descriptorCount = 1,
                            .stageFlags = stages});
    return {device.handle(), vk::DescriptorSetLayoutCreateInfo{.bindingCount = static_cast<std::uint32_t>(bindings.size()),
                                                               .pBindings = bindings.data()}};
}

vk::raii::PipelineLayout pipeline_layout(const gpu::Device& device, vk::DescriptorSetLayout set0, vk::DescriptorSetLayout set1,
                                         vk::ShaderStageFlags stages) {
    const vk::DescriptorSetLayout sets[] = {set0, set1};
    const vk::PushConstantRange draw{.stageFlags = stages, .offset = 0, .size = sizeof(DrawUniforms)};
    return {device.handle(),
            vk::PipelineLayoutCreateInfo{
                .setLayoutCount = 2, .pSetLayouts = sets, .pushConstantRangeCount = 1, .pPushConstantRanges = &draw}};
}

constexpr auto image = vk::DescriptorType::eCombinedImageSampler;
constexpr auto storage = vk::DescriptorType::eStorageBuffer;
constexpr auto uniform = vk::DescriptorType::eUniformBuffer;
constexpr auto fragment = vk::ShaderStageFlagBits::eFragment;
constexpr auto compute = vk::ShaderStageFlagBits::eCompute;

}  // namespace

FamilyLayout::FamilyLayout(const gpu::Device& device)
    : height_sampler(sampler(device, vk::Filter::eLinear, vk::SamplerMipmapMode::eNearest)),
      trilinear_sampler(sampler(device, vk::Filter::eLinear, vk::SamplerMipmapMode::eLinear)),
      nearest_sampler(sampler(device, vk::Filter::eNearest, vk::SamplerMipmapMode::eNearest)),
      volume_sampler(sampler(device, vk::Filter::eLinear, vk::SamplerMipmapMode::eNearest, vk::SamplerAddressMode::eClampToEdge)),
      maps(set_layout(device, std::vector(map_count, image), fragment | compute)),
      scene(set_layout(device, std::array{uniform, storage}, vk::ShaderStageFlagBits::eVertex | fragment)),
      cast(set_layout(device, std::array{storage, storage}, compute)),
      draw_pipeline(pipeline_layout(device, *maps, *scene, vk::ShaderStageFlagBits::eVertex | fragment)),
      cast_pipeline(pipeline_layout(device, *maps, *cast, compute)) {}

DescriptorSet make_descriptor_set(const gpu::Device& device, const vk::raii::DescriptorSetLayout& layout,
                                  std::initializer_list<vk::DescriptorPoolSize> sizes) {
    DescriptorSet set;
    set.pool = vk::raii::DescriptorPool(
        device.handle(), vk::DescriptorPoolCreateInfo{
                             .maxSets = 1, .poolSizeCount = static_cast<std::uint32_t>(sizes.size()), .pPoolSizes = sizes.begin()});
    // Freed with the pool: the plain handle, not the RAII one, which would free it one by one.
    const vk::DescriptorSetAllocateInfo one{.descriptorPool = *set.pool, .descriptorSetCount = 1, .pSetLayouts = &*layout};
    set.handle = (*device.handle()).allocateDescriptorSets(one, *device.handle().getDispatcher()).front();
    return set;
}

}  // namespace relievo
