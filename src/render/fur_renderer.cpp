#include "render/fur_renderer.h"

#include "core/error.h"
#include "core/parallel_for.h"
#include "fur/lock_noise.h"
#include "gpu/buffer.h"
#include "gpu/image.h"
#include "gpu/pipeline.h"
#include "gpu/volume.h"
#include "render/coat_uniforms.h"
#include "render/programs.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <optional>

namespace relievo {

namespace {

constexpr vk::Format colour_format = vk::Format::eR8G8B8A8Srgb;
constexpr vk::Format depth_format = vk::Format::eD32Sfloat;
constexpr std::uint32_t light_size = 1024;

struct Vertex {
    Vec3f position, normal, comb;
    float length;
    Vec3f push;
};

vk::raii::BufferView texel_view(const gpu::Device& device, const gpu::Buffer& buffer, vk::Format format) {
    return {device.handle(), vk::BufferViewCreateInfo{.buffer = *buffer.handle, .format = format, .range = VK_WHOLE_SIZE}};
}

// A buffer of texels; never empty, as Vulkan has no empty buffers.
template <class T>
gpu::Buffer texel_buffer(const gpu::Device& device, const std::vector<T>& data) {
    gpu::Buffer b = gpu::make_buffer(device, std::max<std::size_t>(data.size(), 1) * sizeof(T), vk::BufferUsageFlagBits::eUniformTexelBuffer);
    std::memcpy(b.mapped, data.data(), data.size() * sizeof(T));
    return b;
}

}  // namespace

float strand_reach(const Coat& coat, float spacing, double layers) {
    // The few that lean farthest are cut a little: lists grow with the square of the reach, and so does the time.
    const float sway = 0.7f * coat.spread * coat.length + coat.curl_radius * spacing + 1.3f * coat.width * spacing;
    // What lies half a layer above or below is seen through it, somewhat aside.
    return std::max(sway + 0.1f * coat.length / static_cast<float>(layers), 0.6f * spacing);
}

struct FurRenderer::State {
    gpu::Device device;
    vk::raii::DescriptorSetLayout set_layout = nullptr;
    vk::raii::PipelineLayout layout = nullptr;
    vk::raii::Pipeline skin = nullptr, light = nullptr;
    std::array<vk::raii::Pipeline, 2> strands{nullptr, nullptr};  // straight, curled
    vk::raii::Sampler volume_sampler = nullptr, light_sampler = nullptr;
    gpu::Image noise;
    gpu::Image light_depth;
    gpu::Buffer coat_buffer;
    vk::raii::DescriptorPool pool = nullptr;

    // The model.
    gpu::Buffer vertices, indices, bricks, starts, lists;
    vk::raii::BufferView bricks_view = nullptr, starts_view = nullptr, lists_view = nullptr;
    vk::raii::DescriptorSets sets = nullptr;
    std::uint32_t index_count = 0;
    std::size_t vertex_count = 0;
    CoatUniforms coat{};

    State(const std::string& choice, bool validation) : device(gpu::DeviceSettings{.choice = choice, .validation = validation}) {
        using Type = vk::DescriptorType;
        constexpr Type types[] = {Type::eUniformBuffer, Type::eUniformTexelBuffer, Type::eUniformTexelBuffer, Type::eUniformTexelBuffer, Type::eCombinedImageSampler, Type::eCombinedImageSampler};
        constexpr auto stages = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;
        std::vector<vk::DescriptorSetLayoutBinding> bindings;
        for (std::uint32_t b = 0; b < std::size(types); ++b) bindings.push_back({.binding = b, .descriptorType = types[b], .descriptorCount = 1, .stageFlags = stages});
        set_layout = {device.handle(), vk::DescriptorSetLayoutCreateInfo{.bindingCount = static_cast<std::uint32_t>(bindings.size()), .pBindings = bindings.data()}};
        const vk::PushConstantRange range{.stageFlags = stages, .size = sizeof(FurMatrices)};
        layout = {device.handle(), vk::PipelineLayoutCreateInfo{.setLayoutCount = 1, .pSetLayouts = &*set_layout, .pushConstantRangeCount = 1, .pPushConstantRanges = &range}};
        const vk::VertexInputAttributeDescription attributes[] = {{.location = 0, .format = vk::Format::eR32G32B32Sfloat, .offset = offsetof(Vertex, position)},
                                                                  {.location = 1, .format = vk::Format::eR32G32B32Sfloat, .offset = offsetof(Vertex, normal)},
                                                                  {.location = 2, .format = vk::Format::eR32G32B32A32Sfloat, .offset = offsetof(Vertex, comb)},
                                                                  {.location = 3, .format = vk::Format::eR32G32B32Sfloat, .offset = offsetof(Vertex, push)}};
        gpu::DrawPipeline settings{.vertex = program_words("shells/skin.vert"),
                                   .fragment = program_words("shells/skin.frag"),
                                   .targets = std::span(&colour_format, 1),
                                   .attributes = attributes,
                                   .vertex_bytes = sizeof(Vertex),
                                   .depth = depth_format};
        skin = gpu::make_pipeline(device, *layout, settings);
        settings.vertex = program_words("shells/strands.vert");
        settings.fragment = program_words("shells/strands.frag");
        for (std::uint32_t curled = 0; curled < 2; ++curled) {
            settings.fragment_constants = std::span(&curled, 1);
            strands[curled] = gpu::make_pipeline(device, *layout, settings);
        }
        light = gpu::make_pipeline(device, *layout,
                                   gpu::DrawPipeline{.vertex = program_words("shells/light.vert"), .attributes = attributes, .vertex_bytes = sizeof(Vertex), .depth = depth_format});
        const auto sampler = [&](vk::Filter filter, vk::SamplerAddressMode mode) {
            return vk::raii::Sampler(device.handle(), vk::SamplerCreateInfo{.magFilter = filter, .minFilter = filter, .addressModeU = mode, .addressModeV = mode, .addressModeW = mode});
        };
        volume_sampler = sampler(vk::Filter::eLinear, vk::SamplerAddressMode::eRepeat);
        const bool smooth = bool(device.physical().getFormatProperties(depth_format).optimalTilingFeatures & vk::FormatFeatureFlagBits::eSampledImageFilterLinear);
        light_sampler = sampler(smooth ? vk::Filter::eLinear : vk::Filter::eNearest, vk::SamplerAddressMode::eClampToEdge);
        const LockNoise locks = lock_noise();
        constexpr std::uint32_t n = LockNoise::size;
        noise = gpu::make_volume(device, vk::Format::eR8G8B8A8Snorm, {n, n, n}, 4, [&](int z, int y, std::byte* out) {
            std::memcpy(out, locks.texels.data() + (static_cast<std::size_t>(z) * n + static_cast<std::size_t>(y)) * n, n * 4);
        });
        light_depth = gpu::make_image(device, depth_format, {light_size, light_size}, 1, vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eSampled);
        coat_buffer = gpu::make_buffer(device, sizeof(CoatUniforms), vk::BufferUsageFlagBits::eUniformBuffer);
        const vk::DescriptorPoolSize sizes[] = {{Type::eUniformBuffer, 1}, {Type::eUniformTexelBuffer, 3}, {Type::eCombinedImageSampler, 2}};
        pool = {device.handle(), vk::DescriptorPoolCreateInfo{.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, .maxSets = 1, .poolSizeCount = 3, .pPoolSizes = sizes}};
    }

    void load(const FurModel& model) {
        const Mesh& mesh = *model.mesh;
        assert(mesh.normals.size() == mesh.positions.size() && model.comb->size() == mesh.positions.size() && mesh.faces() > 0);
        const auto elements = device.physical().getProperties().limits.maxTexelBufferElements;
        if (model.grid->lists.size() > elements || model.grid->starts.size() > elements)
            throw Error("draw", "fur on " + mesh.name, device.info().name + " reads no more than " + std::to_string(elements) + " texels", "grow fewer (--density)");
        vertices = gpu::make_buffer(device, mesh.positions.size() * sizeof(Vertex), vk::BufferUsageFlagBits::eVertexBuffer);
        auto* to = vertices.as<Vertex>();
        parallel_for(static_cast<int>(mesh.positions.size()), 65536, 0, [&](int begin, int end) {
            for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v)
                to[v] = {mesh.positions[v], mesh.normals[v], (*model.comb)[v], model.lengths ? (*model.lengths)[v] : 1.0f, model.pushes ? (*model.pushes)[v] : Vec3f()};
        });
        index_count = static_cast<std::uint32_t>(mesh.indices.size());
        vertex_count = mesh.positions.size();
        indices = gpu::make_buffer(device, mesh.indices.size() * 4, vk::BufferUsageFlagBits::eIndexBuffer);
        std::ranges::copy(mesh.indices, indices.as<std::uint32_t>());
        bricks_view = nullptr;
        starts_view = nullptr;
        lists_view = nullptr;
        bricks = texel_buffer(device, model.grid->bricks);
        starts = texel_buffer(device, model.grid->starts);
        lists = texel_buffer(device, model.grid->lists);
        bricks_view = texel_view(device, bricks, vk::Format::eR32Uint);
        starts_view = texel_view(device, starts, vk::Format::eR32Uint);
        lists_view = texel_view(device, lists, vk::Format::eR32G32Uint);

        sets = nullptr;
        sets = vk::raii::DescriptorSets(device.handle(), vk::DescriptorSetAllocateInfo{.descriptorPool = *pool, .descriptorSetCount = 1, .pSetLayouts = &*set_layout});
        const vk::DescriptorBufferInfo uniforms{.buffer = *coat_buffer.handle, .range = VK_WHOLE_SIZE};
        const vk::BufferView views[] = {*bricks_view, *starts_view, *lists_view};
        const vk::DescriptorImageInfo volume{.sampler = *volume_sampler, .imageView = *noise.view, .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
        const vk::DescriptorImageInfo lit{.sampler = *light_sampler, .imageView = *light_depth.view, .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
        using Type = vk::DescriptorType;
        std::vector<vk::WriteDescriptorSet> writes;
        writes.push_back({.dstSet = *sets[0], .dstBinding = 0, .descriptorCount = 1, .descriptorType = Type::eUniformBuffer, .pBufferInfo = &uniforms});
        for (std::uint32_t b = 0; b < 3; ++b)
            writes.push_back({.dstSet = *sets[0], .dstBinding = 1 + b, .descriptorCount = 1, .descriptorType = Type::eUniformTexelBuffer, .pTexelBufferView = &views[b]});
        writes.push_back({.dstSet = *sets[0], .dstBinding = 4, .descriptorCount = 1, .descriptorType = Type::eCombinedImageSampler, .pImageInfo = &volume});
        writes.push_back({.dstSet = *sets[0], .dstBinding = 5, .descriptorCount = 1, .descriptorType = Type::eCombinedImageSampler, .pImageInfo = &lit});
        device.handle().updateDescriptorSets(writes, {});

        coat = coat_uniforms(model.coat, model.spacing);
        coat.reach = model.grid->reach;
        coat.off = model.grid->off;
        coat.cells_per_unit = model.grid->cells_per_unit;
        coat.low_x = model.grid->low.x;
        coat.low_y = model.grid->low.y;
        coat.low_z = model.grid->low.z;
        coat.bricks_x = model.grid->size[0];
        coat.bricks_y = model.grid->size[1];
        coat.bricks_z = model.grid->size[2];
    }

    void bind(const vk::raii::CommandBuffer& commands, const vk::raii::Pipeline& pipeline, const FurMatrices& push, vk::Extent2D extent) const {
        constexpr auto stages = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;
        commands.setViewport(0, vk::Viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1});
        commands.setScissor(0, vk::Rect2D{{0, 0}, extent});
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline);
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout, 0, {*sets[0]}, {});
        commands.pushConstants<FurMatrices>(*layout, stages, 0, push);
        commands.bindVertexBuffers(0, {*vertices.handle}, {0});
        commands.bindIndexBuffer(*indices.handle, 0, vk::IndexType::eUint32);
    }

    void record_light(const vk::raii::CommandBuffer& commands, const FurMatrices& push) const {
        gpu::transition(commands, light_depth, vk::ImageLayout::eUndefined, vk::ImageLayout::eDepthAttachmentOptimal);
        const vk::RenderingAttachmentInfo nearest{.imageView = *light_depth.view,
                                                  .imageLayout = vk::ImageLayout::eDepthAttachmentOptimal,
                                                  .loadOp = vk::AttachmentLoadOp::eClear,
                                                  .storeOp = vk::AttachmentStoreOp::eStore,
                                                  .clearValue = vk::ClearDepthStencilValue{1, 0}};
        commands.beginRendering({.renderArea = {{0, 0}, light_depth.extent}, .layerCount = 1, .pDepthAttachment = &nearest});
        bind(commands, light, push, light_depth.extent);
        commands.drawIndexed(index_count, 1, 0, 0, 0);
        commands.endRendering();
        gpu::transition(commands, light_depth, vk::ImageLayout::eDepthAttachmentOptimal, vk::ImageLayout::eShaderReadOnlyOptimal);
    }
};

FurRenderer::FurRenderer(const std::string& device, bool validation)
    : state_(gpu::vulkan_errors_as("start", "the device", [&] { return std::make_unique<State>(device, validation); })) {}
FurRenderer::~FurRenderer() = default;

std::string FurRenderer::device_name() const { return state_->device.info().name; }
std::vector<std::string> FurRenderer::validation_messages() const { return state_->device.validation_messages(); }

void FurRenderer::load(const FurModel& model) {
    gpu::vulkan_errors_as("load", model.mesh->name, [&] { state_->load(model); });
}

void FurRenderer::push(std::span<const Vec3f> pushes) {
    assert(pushes.size() == state_->vertex_count);
    auto* to = state_->vertices.as<Vertex>();
    for (std::size_t v = 0; v < pushes.size(); ++v) to[v].push = pushes[v];
}

FurFrames FurRenderer::draw(const FurView& view) {
    State& s = *state_;
    const MeshView& camera = view.camera;
    assert(view.layers >= 1 && view.passes >= 1 && s.index_count > 0);
    const auto limit = static_cast<int>(s.device.physical().getProperties().limits.maxFramebufferWidth);
    if (camera.width < 1 || camera.height < 1 || camera.width > limit || camera.height > limit)
        throw Error("draw", "a picture of " + std::to_string(camera.width) + " x " + std::to_string(camera.height),
                    s.device.info().name + " draws 1 to " + std::to_string(limit) + " pixels a side");
    return gpu::vulkan_errors_as("draw", "fur", [&] {
        const vk::Extent2D extent{static_cast<std::uint32_t>(camera.width), static_cast<std::uint32_t>(camera.height)};
        using Usage = vk::ImageUsageFlagBits;
        // One sample a pixel: on the software device four cost four times as much, and further passes buy more for that.
        const gpu::Image colour = gpu::make_image(s.device, colour_format, extent, 1, Usage::eColorAttachment | Usage::eTransferSrc);
        const gpu::Image depth = gpu::make_image(s.device, depth_format, extent, 1, Usage::eDepthStencilAttachment);
        const std::size_t pixels = std::size_t{extent.width} * extent.height;
        const gpu::Buffer texels = gpu::make_buffer(s.device, pixels * 4, vk::BufferUsageFlagBits::eTransferDst);

        set_view(s.coat, view);
        FurFrames frames;
        frames.colour = ImageF(camera.width, camera.height, 3);
        frames.coverage = ImageF(camera.width, camera.height, 1);
        for (int pass = 0; pass < view.passes; ++pass) {
            const auto start = std::chrono::steady_clock::now();
            const FurPass moved = fur_pass(view, pass, s.coat.fur_length);
            s.coat.sample_shift = moved.sample_shift;
            std::memcpy(s.coat_buffer.mapped, &s.coat, sizeof s.coat);
            s.device.run([&](const vk::raii::CommandBuffer& commands) {
                s.record_light(commands, moved.light);
                gpu::transition(commands, colour, vk::ImageLayout::eUndefined, vk::ImageLayout::eColorAttachmentOptimal);
                gpu::transition(commands, depth, vk::ImageLayout::eUndefined, vk::ImageLayout::eDepthAttachmentOptimal);
                const vk::RenderingAttachmentInfo into{.imageView = *colour.view,
                                                       .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
                                                       .loadOp = vk::AttachmentLoadOp::eClear,
                                                       .storeOp = vk::AttachmentStoreOp::eStore,
                                                       .clearValue = vk::ClearColorValue(std::array{0.0f, 0.0f, 0.0f, 0.0f})};
                const vk::RenderingAttachmentInfo nearest{.imageView = *depth.view,
                                                          .imageLayout = vk::ImageLayout::eDepthAttachmentOptimal,
                                                          .loadOp = vk::AttachmentLoadOp::eClear,
                                                          .storeOp = vk::AttachmentStoreOp::eDontCare,
                                                          .clearValue = vk::ClearDepthStencilValue{1, 0}};
                commands.beginRendering({.renderArea = {{0, 0}, extent}, .layerCount = 1, .colorAttachmentCount = 1, .pColorAttachments = &into, .pDepthAttachment = &nearest});
                const FurMatrices& push = moved.eye;
                s.bind(commands, s.skin, push, extent);
                commands.drawIndexed(s.index_count, 1, 0, 0, 0);
                s.bind(commands, s.strands[s.coat.curl_radius > 0], push, extent);
                commands.drawIndexed(s.index_count, static_cast<std::uint32_t>(view.layers), 0, 0, 0);
                commands.endRendering();
                gpu::transition(commands, colour, vk::ImageLayout::eColorAttachmentOptimal, vk::ImageLayout::eTransferSrcOptimal);
                gpu::read_back(commands, colour, texels);
            });
            add_pass(frames, {texels.as<std::uint8_t>(), pixels * 4}, view.passes);
            frames.frame_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        }
        return frames;
    });
}

}  // namespace relievo
