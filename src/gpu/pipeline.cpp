#include "gpu/pipeline.h"

#include <vector>

namespace relievo::gpu {

namespace {

vk::raii::ShaderModule module_of(const Device& device, std::span<const std::uint32_t> words) {
    return {device.handle(), vk::ShaderModuleCreateInfo{.codeSize = words.size_bytes(), .pCode = words.data()}};
}

// Specialization constants numbered from 0.
struct Constants {
    explicit Constants(std::span<const std::uint32_t> values) {
        for (std::uint32_t i = 0; i < values.size(); ++i)
            entries.push_back({.constantID = i, .offset = i * static_cast<std::uint32_t>(sizeof(std::uint32_t)), .size = sizeof(std::uint32_t)});
        info = vk::SpecializationInfo{.mapEntryCount = static_cast<std::uint32_t>(entries.size()), .pMapEntries = entries.data(), .dataSize = values.size_bytes(), .pData = values.data()};
    }
    Constants(const Constants&) = delete;
    Constants& operator=(const Constants&) = delete;
    std::vector<vk::SpecializationMapEntry> entries;
    vk::SpecializationInfo info;
};

}  // namespace

vk::raii::Pipeline make_pipeline(const Device& device, vk::PipelineLayout layout, const DrawPipeline& settings) {
    const auto vertex = module_of(device, settings.vertex);
    vk::raii::ShaderModule fragment = nullptr;
    if (!settings.fragment.empty()) fragment = module_of(device, settings.fragment);
    const Constants constants(settings.fragment_constants);
    const vk::PipelineShaderStageCreateInfo stages[] = {
        {.stage = vk::ShaderStageFlagBits::eVertex, .module = *vertex, .pName = "main"},
        {.stage = vk::ShaderStageFlagBits::eFragment, .module = *fragment, .pName = "main", .pSpecializationInfo = &constants.info}};

    const bool has_vertices = !settings.attributes.empty();
    const bool has_depth = settings.depth != vk::Format::eUndefined;
    const vk::VertexInputBindingDescription binding{.stride = settings.vertex_bytes};
    const vk::PipelineVertexInputStateCreateInfo vertices{.vertexBindingDescriptionCount = has_vertices ? 1u : 0u,
                                                          .pVertexBindingDescriptions = &binding,
                                                          .vertexAttributeDescriptionCount = static_cast<std::uint32_t>(settings.attributes.size()),
                                                          .pVertexAttributeDescriptions = settings.attributes.data()};
    const vk::PipelineInputAssemblyStateCreateInfo assembly{
        .topology = has_vertices ? vk::PrimitiveTopology::eTriangleList : vk::PrimitiveTopology::eTriangleStrip};
    const vk::PipelineDepthStencilStateCreateInfo depth{
        .depthTestEnable = has_depth, .depthWriteEnable = has_depth, .depthCompareOp = settings.blended ? vk::CompareOp::eLessOrEqual : vk::CompareOp::eLess};
    const vk::PipelineViewportStateCreateInfo viewport{.viewportCount = 1, .scissorCount = 1};
    const vk::PipelineRasterizationStateCreateInfo raster{.lineWidth = 1};
    const vk::PipelineMultisampleStateCreateInfo one_sample{.rasterizationSamples = vk::SampleCountFlagBits::e1};
    const vk::PipelineColorBlendAttachmentState write_all{.blendEnable = settings.blended,
                                                          .srcColorBlendFactor = vk::BlendFactor::eSrcAlpha,
                                                          .dstColorBlendFactor = vk::BlendFactor::eOneMinusSrcAlpha,
                                                          .colorBlendOp = vk::BlendOp::eAdd,
                                                          .srcAlphaBlendFactor = vk::BlendFactor::eOne,
                                                          .dstAlphaBlendFactor = vk::BlendFactor::eOneMinusSrcAlpha,
                                                          .alphaBlendOp = vk::BlendOp::eAdd,
                                                          .colorWriteMask = vk::FlagTraits<vk::ColorComponentFlagBits>::allFlags};
    const std::vector<vk::PipelineColorBlendAttachmentState> attachments(settings.targets.size(), write_all);
    const vk::PipelineColorBlendStateCreateInfo blend{.attachmentCount = static_cast<std::uint32_t>(attachments.size()),
                                                      .pAttachments = attachments.data()};
    const vk::DynamicState dynamic[] = {vk::DynamicState::eViewport, vk::DynamicState::eScissor};
    const vk::PipelineDynamicStateCreateInfo dynamic_state{.dynamicStateCount = 2, .pDynamicStates = dynamic};
    const vk::PipelineRenderingCreateInfo rendering{.colorAttachmentCount = static_cast<std::uint32_t>(settings.targets.size()),
                                                    .pColorAttachmentFormats = settings.targets.data(),
                                                    .depthAttachmentFormat = settings.depth};
    return {device.handle(), nullptr,
            vk::GraphicsPipelineCreateInfo{.pNext = &rendering,
                                           .stageCount = settings.fragment.empty() ? 1u : 2u,
                                           .pStages = stages,
                                           .pVertexInputState = &vertices,
                                           .pInputAssemblyState = &assembly,
                                           .pViewportState = &viewport,
                                           .pRasterizationState = &raster,
                                           .pMultisampleState = &one_sample,
                                           .pDepthStencilState = &depth,
                                           .pColorBlendState = &blend,
                                           .pDynamicState = &dynamic_state,
                                           .layout = layout}};
}

vk::raii::Pipeline make_pipeline(const Device& device, vk::PipelineLayout layout, std::span<const std::uint32_t> compute, std::span<const std::uint32_t> values) {
    const auto module = module_of(device, compute);
    const Constants constants(values);
    return {device.handle(), nullptr,
            vk::ComputePipelineCreateInfo{.stage = {.stage = vk::ShaderStageFlagBits::eCompute, .module = *module, .pName = "main", .pSpecializationInfo = &constants.info},
                                          .layout = layout}};
}

}  // namespace relievo::gpu
