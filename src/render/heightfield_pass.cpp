#include "render/heightfield_pass.h"

#include "techniques/shadow_bias.h"

#include "gpu/pipeline.h"
#include "render/programs.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace relievo {

namespace {

std::span<const std::uint32_t> words_of(std::string_view host, std::string_view technique) {
    const auto all = programs();
    const auto it = std::ranges::find_if(all, [&](const Program& p) { return p.host == host && p.technique == technique; });
    assert(it != all.end() && "the build makes a program of every host and technique");
    return it->words;
}

constexpr auto depth_format = vk::Format::eD32Sfloat;  // one of the two that every device has

// Other geometry is drawn into pictures alone: the facts under a pixel stay the relief's.
bool meets_sheet(const HeightFieldPass::Draw& draw) {
    return draw.technique != nullptr && draw.host.targets.size() == 1 && draw.options.sheet != glsl::sheet_none;
}

}  // namespace

vk::Pipeline HeightFieldPass::sheet_pipeline(const Draw& draw) {
    const Key key{"sheet.frag", {}, {}, draw.host.targets, true};
    auto it = pipelines_.find(key);
    if (it == pipelines_.end())
        it = pipelines_
                 .emplace(key, gpu::make_pipeline(device_, *layout_.draw_pipeline,
                                                  gpu::DrawPipeline{.vertex = words_of("sheet.vert", {}),
                                                                    .fragment = words_of("sheet.frag", {}),
                                                                    .fragment_constants = {},
                                                                    .targets = draw.host.targets,
                                                                    .depth = depth_format}))
                 .first;
    return *it->second;
}

vk::Pipeline HeightFieldPass::pipeline(const Draw& draw) {
    const std::string_view id = draw.technique ? draw.technique->id : std::string_view{};
    const int shadow = draw.technique ? shadow_of(*draw.technique, draw.options) : glsl::shadow_none;
    const auto shaded_by = static_cast<std::uint32_t>(draw.technique ? draw.technique->shaded_by : ShadedBy::polygon);
    // The specialization constants of surface.glsl; a host that runs no technique has none and ignores them.
    std::vector<std::uint32_t> constants{static_cast<std::uint32_t>(shadow), shaded_by, draw.technique ? draw.scene.light_count() : 0};
    for (const Modifier& m : modifiers())
        if (m.choice != &DrawOptions::shadow && m.choice != &DrawOptions::sides) constants.push_back(static_cast<std::uint32_t>(draw.options.*m.choice));
    const Key key{draw.host.file, std::string(id), constants, draw.host.targets, meets_sheet(draw)};
    auto it = pipelines_.find(key);
    if (it == pipelines_.end()) {
        it = pipelines_
                 .emplace(key, gpu::make_pipeline(device_, *layout_.draw_pipeline,
                                                  gpu::DrawPipeline{.vertex = words_of("quad.vert", {}),
                                                                    .fragment = words_of(draw.host.file, id),
                                                                    .fragment_constants = constants,
                                                                    .targets = draw.host.targets,
                                                                    .depth = meets_sheet(draw) ? depth_format : vk::Format::eUndefined}))
                 .first;
        if (meets_sheet(draw)) sheet_pipeline(draw);
    }
    return *it->second;
}

vk::Pipeline HeightFieldPass::cast_pipeline(const Technique& technique) {
    const Key key{"cast.comp", std::string(technique.id), {}, {}, false};
    auto it = pipelines_.find(key);
    if (it == pipelines_.end())
        it =
            pipelines_.emplace(key, gpu::make_pipeline(device_, *layout_.cast_pipeline, words_of("cast.comp", technique.id))).first;
    return *it->second;
}

void HeightFieldPass::record(const vk::raii::CommandBuffer& commands, const Draw& draw, std::span<const vk::ImageView> targets,
                             vk::Extent2D extent) {
    assert(targets.size() == draw.host.targets.size());
    std::vector<vk::RenderingAttachmentInfo> attachments;
    for (const vk::ImageView view : targets) {
        const Vec3f clear = attachments.empty() ? draw.background : Vec3f{};
        // Alpha 1 only where the picture is shown; the other hosts read 0 as "the pixel does not meet the base".
        const bool picture = draw.host.targets.size() == 1;
        attachments.push_back({.imageView = view,
                               .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
                               .loadOp = vk::AttachmentLoadOp::eClear,
                               .storeOp = vk::AttachmentStoreOp::eStore,
                               .clearValue = vk::ClearColorValue(std::array{clear.x, clear.y, clear.z, picture ? 1.0f : 0.0f})});
    }
    const bool sheet = meets_sheet(draw);
    if (sheet) {
        if (depth_.extent != extent)
            depth_ = gpu::make_image(device_, depth_format, extent, 1, vk::ImageUsageFlagBits::eDepthStencilAttachment);
        gpu::transition(commands, depth_, vk::ImageLayout::eUndefined, vk::ImageLayout::eDepthAttachmentOptimal);
    }
    const vk::RenderingAttachmentInfo depth{.imageView = *depth_.view,
                                            .imageLayout = vk::ImageLayout::eDepthAttachmentOptimal,
                                            .loadOp = vk::AttachmentLoadOp::eClear,
                                            .storeOp = vk::AttachmentStoreOp::eDontCare,
                                            .clearValue = vk::ClearDepthStencilValue{1.0f, 0}};
    const vk::Rect2D area{{0, 0}, extent};
    const vk::Pipeline drawn = pipeline(draw);
    commands.beginRendering({.renderArea = area,
                             .layerCount = 1,
                             .colorAttachmentCount = static_cast<std::uint32_t>(attachments.size()),
                             .pColorAttachments = attachments.data(),
                             .pDepthAttachment = sheet ? &depth : nullptr});
    commands.setViewport(0, vk::Viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1});
    commands.setScissor(0, area);
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, drawn);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout_.draw_pipeline, 0,
                                {draw.material.maps(), draw.scene.set()}, {});
    glsl::DrawNumbers numbers = draw.options.numbers;
    numbers.chart = chart_of(draw.options, draw.scene.periods());
    const DrawUniforms uniforms{draw.params, {draw.material.height_scale(), draw.material.zero_level(),
                                             draw.technique != nullptr ? shadow_bias(*draw.technique, draw.params) : 0},
                                numbers};
    commands.pushConstants<DrawUniforms>(*layout_.draw_pipeline, vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0,
                                         uniforms);
    // A base of one piece is seen from one side.
    if (draw.technique == nullptr || !draw.scene.from_behind() || draw.options.sides == sides_both) commands.draw(4, 1, 0, 0);
    if (sheet) {
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, sheet_pipeline(draw));
        commands.draw(4, 1, 0, 0);
    }
    commands.endRendering();
}

TargetSet make_targets(const gpu::Device& device, const FragmentHost& host, int width, int height) {
    TargetSet targets;
    targets.extent = vk::Extent2D{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
    for (const vk::Format format : host.targets)
        targets.images.push_back(gpu::make_image(device, format, targets.extent, 1,
                                                 vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc));
    return targets;
}

}  // namespace relievo
