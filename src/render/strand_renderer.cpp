#include "render/strand_renderer.h"

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
#include <utility>

namespace relievo {

namespace {

constexpr vk::Format colour_format = vk::Format::eR8G8B8A8Srgb;
constexpr vk::Format depth_format = vk::Format::eD32Sfloat;
constexpr std::uint32_t light_size = 1024;
constexpr std::size_t most_strands = std::size_t{1} << 24;  // plot.comp's key has 24 bits for a strand's number
constexpr int group_size = 64;                              // of grow.comp and plot.comp

struct Vertex {
    Vec3f position, normal, comb;
    float length;
    Vec3f push;
};

// Names of the set's bindings, as shaders/hosts/strands has them.
enum Binding : std::uint32_t { coat_binding, places_binding, natures_binding, points_binding, seen_binding, noise_binding, light_binding, skin_binding, grown_binding, pushes_binding, tiles_binding, bindings };

std::uint32_t tile_count(vk::Extent2D picture) {
    constexpr std::uint32_t side = tile_px;
    return ((picture.width + side - 1) / side) * ((picture.height + side - 1) / side);
}

// The picture and what it is made from; kept while the size stays.
struct Target {
    vk::Extent2D extent;
    gpu::Image colour, depth;
    gpu::Buffer seen, tiles, texels;  // tiles: whether they hold strands
};

}  // namespace

struct StrandRenderer::State {
    gpu::Device device;
    vk::raii::DescriptorSetLayout set_layout = nullptr;
    vk::raii::PipelineLayout layout = nullptr;
    vk::raii::Pipeline skin = nullptr, light = nullptr, plot = nullptr, shade = nullptr;
    std::array<vk::raii::Pipeline, 4> grow{nullptr, nullptr, nullptr, nullptr};  // straight, curled; the same pushed
    vk::raii::Sampler volume_sampler = nullptr, light_sampler = nullptr, exact_sampler = nullptr;
    gpu::Image noise, light_depth;
    gpu::Buffer coat_buffer;
    vk::raii::DescriptorPool pool = nullptr;
    vk::raii::DescriptorSets sets = nullptr;
    vk::raii::QueryPool stamps = nullptr;
    std::optional<Target> target;

    gpu::Buffer vertices, indices, places, natures, points, pushes;
    vk::raii::BufferView places_view = nullptr, natures_view = nullptr, points_view = nullptr, pushes_view = nullptr;  // the last is nothing where no force bends strands
    std::size_t vertex_count = 0;
    std::uint32_t index_count = 0;
    std::size_t points_room = 0;  // points that their buffer holds
    int grown_pieces = 0;         // of the points that stand in their buffer; 0: none
    FurFrames empty;              // frames of zeros, made beforehand
    CoatUniforms coat{};
    std::optional<FurMatrices> lit_by;  // what the light's picture was drawn with

    State(const std::string& choice, bool validation) : device(gpu::DeviceSettings{.choice = choice, .validation = validation}) {
        if (!device.has_wide_atomics()) throw Error("plot strands", "on " + device.info().name, "it has no atomic minima of 64 bits in buffers", "take another device (--device software), or --mode shells");
        using Type = vk::DescriptorType;
        constexpr std::array<Type, bindings> types{Type::eUniformBuffer,        Type::eUniformTexelBuffer,   Type::eUniformTexelBuffer,   Type::eUniformTexelBuffer, Type::eStorageBuffer,
                                                   Type::eCombinedImageSampler, Type::eCombinedImageSampler, Type::eCombinedImageSampler, Type::eStorageBuffer,      Type::eUniformTexelBuffer, Type::eStorageBuffer};
        constexpr auto stages_ = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment | vk::ShaderStageFlagBits::eCompute;
        std::vector<vk::DescriptorSetLayoutBinding> layouts;
        for (std::uint32_t b = 0; b < bindings; ++b) layouts.push_back({.binding = b, .descriptorType = types[b], .descriptorCount = 1, .stageFlags = stages_});
        set_layout = {device.handle(), vk::DescriptorSetLayoutCreateInfo{.bindingCount = bindings, .pBindings = layouts.data()}};
        const vk::PushConstantRange range{.stageFlags = stages_, .size = sizeof(FurMatrices)};
        layout = {device.handle(), vk::PipelineLayoutCreateInfo{.setLayoutCount = 1, .pSetLayouts = &*set_layout, .pushConstantRangeCount = 1, .pPushConstantRanges = &range}};
        const vk::VertexInputAttributeDescription attributes[] = {{.location = 0, .format = vk::Format::eR32G32B32Sfloat, .offset = offsetof(Vertex, position)},
                                                                  {.location = 1, .format = vk::Format::eR32G32B32Sfloat, .offset = offsetof(Vertex, normal)},
                                                                  {.location = 2, .format = vk::Format::eR32G32B32A32Sfloat, .offset = offsetof(Vertex, comb)},
                                                                  {.location = 3, .format = vk::Format::eR32G32B32Sfloat, .offset = offsetof(Vertex, push)}};
        const std::span<const vk::Format> colours(&colour_format, 1);
        skin = gpu::make_pipeline(device, *layout,
                                  gpu::DrawPipeline{.vertex = program_words("shells/skin.vert"),
                                                    .fragment = program_words("shells/skin.frag"),
                                                    .targets = colours,
                                                    .attributes = attributes,
                                                    .vertex_bytes = sizeof(Vertex),
                                                    .depth = depth_format});
        light = gpu::make_pipeline(device, *layout,
                                   gpu::DrawPipeline{.vertex = program_words("shells/light.vert"), .attributes = attributes, .vertex_bytes = sizeof(Vertex), .depth = depth_format});
        shade = gpu::make_pipeline(device, *layout, gpu::DrawPipeline{.vertex = program_words("strands/shade.vert"), .fragment = program_words("strands/shade.frag"), .targets = colours});
        for (std::uint32_t form = 0; form < 4; ++form) {
            const std::uint32_t constants[] = {form & 1u, form >> 1};
            grow[form] = gpu::make_pipeline(device, *layout, program_words("strands/grow.comp"), constants);
        }
        plot = gpu::make_pipeline(device, *layout, program_words("strands/plot.comp"));
        const auto sampler = [&](vk::Filter filter, vk::SamplerAddressMode mode) {
            return vk::raii::Sampler(device.handle(), vk::SamplerCreateInfo{.magFilter = filter, .minFilter = filter, .addressModeU = mode, .addressModeV = mode, .addressModeW = mode});
        };
        volume_sampler = sampler(vk::Filter::eLinear, vk::SamplerAddressMode::eRepeat);
        exact_sampler = sampler(vk::Filter::eNearest, vk::SamplerAddressMode::eClampToEdge);
        const bool smooth = bool(device.physical().getFormatProperties(depth_format).optimalTilingFeatures & vk::FormatFeatureFlagBits::eSampledImageFilterLinear);
        light_sampler = sampler(smooth ? vk::Filter::eLinear : vk::Filter::eNearest, vk::SamplerAddressMode::eClampToEdge);
        const LockNoise locks = lock_noise();
        constexpr std::uint32_t n = LockNoise::size;
        // As floats: software devices take longer to convert bytes than to fetch four times as many.
        noise = gpu::make_volume(device, vk::Format::eR32G32B32A32Sfloat, {n, n, n}, 16, [&](int z, int y, std::byte* out) {
            for (std::size_t x = 0; x < n; ++x) {
                std::array<float, 4> texel;
                for (std::size_t c = 0; c < 4; ++c) texel[c] = static_cast<float>(locks.texels[(static_cast<std::size_t>(z) * n + static_cast<std::size_t>(y)) * n + x][c]) / 127;
                std::memcpy(out + x * 16, texel.data(), 16);
            }
        });
        light_depth = gpu::make_image(device, depth_format, {light_size, light_size}, 1, vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eSampled);
        coat_buffer = gpu::make_buffer(device, sizeof(CoatUniforms), vk::BufferUsageFlagBits::eUniformBuffer);
        const vk::DescriptorPoolSize sizes[] = {{Type::eUniformBuffer, 1}, {Type::eUniformTexelBuffer, 4}, {Type::eStorageBuffer, 3}, {Type::eCombinedImageSampler, 3}};
        pool = {device.handle(), vk::DescriptorPoolCreateInfo{.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, .maxSets = 1, .poolSizeCount = 4, .pPoolSizes = sizes}};
        stamps = {device.handle(), vk::QueryPoolCreateInfo{.queryType = vk::QueryType::eTimestamp, .queryCount = 7}};
    }

    vk::raii::BufferView texel_view(const gpu::Buffer& buffer, vk::Format format) const {
        return {device.handle(), vk::BufferViewCreateInfo{.buffer = *buffer.handle, .format = format, .range = VK_WHOLE_SIZE}};
    }

    template <class Data>
    void texels(gpu::Buffer& buffer, vk::raii::BufferView& view, const Data& data, vk::Format format) const {
        view = nullptr;
        buffer = gpu::make_buffer(device, data.size() * sizeof data[0], vk::BufferUsageFlagBits::eUniformTexelBuffer);
        std::memcpy(buffer.mapped, data.data(), data.size() * sizeof data[0]);
        view = texel_view(buffer, format);
    }

    void load(const StrandModel& model) {
        const Mesh& mesh = *model.mesh;
        assert(mesh.normals.size() == mesh.positions.size() && model.comb->size() == mesh.positions.size() && mesh.faces() > 0 && !model.strands->places.empty());
        if (model.strands->places.size() > most_strands)
            throw Error("plot", "fur on " + mesh.name, std::to_string(model.strands->places.size()) + " strands are more than 16 million", "grow fewer (--density)");
        vertices = gpu::make_buffer(device, mesh.positions.size() * sizeof(Vertex), vk::BufferUsageFlagBits::eVertexBuffer);
        auto* to = vertices.as<Vertex>();
        parallel_for(static_cast<int>(mesh.positions.size()), 65536, 0, [&](int begin, int end) {
            for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v)
                to[v] = {mesh.positions[v], mesh.normals[v], (*model.comb)[v], model.lengths ? (*model.lengths)[v] : 1.0f, Vec3f()};
        });
        pushes_view = nullptr;
        vertex_count = mesh.positions.size();
        index_count = static_cast<std::uint32_t>(mesh.indices.size());
        indices = gpu::make_buffer(device, mesh.indices.size() * 4, vk::BufferUsageFlagBits::eIndexBuffer);
        std::ranges::copy(mesh.indices, indices.as<std::uint32_t>());
        texels(places, places_view, model.strands->places, vk::Format::eR32G32B32A32Uint);
        texels(natures, natures_view, model.strands->natures, vk::Format::eR32G32Uint);
        lit_by.reset();
        const Coat& c = model.coat;
        coat = coat_uniforms(c, model.spacing);
        coat.strands = static_cast<int>(model.strands->places.size());
        grown_pieces = 0;
    }

    void make_points(std::size_t strands, int pieces) {
        const std::size_t wanted = (static_cast<std::size_t>(pieces) + 1) * strands;
        if (wanted <= points_room) return;
        const auto& limits = device.physical().getProperties().limits;
        if (wanted > limits.maxTexelBufferElements || wanted * 16 > limits.maxStorageBufferRange)
            throw Error("plot", "fur", device.info().name + " has no room for " + std::to_string(strands) + " strands of " + std::to_string(pieces) + " pieces", "grow fewer (--density), or take fewer --layers");
        points_room = 0;
        points_view = nullptr;
        points = gpu::make_buffer(device, wanted * 16, vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eUniformTexelBuffer);
        points_view = texel_view(points, vk::Format::eR32G32B32A32Sfloat);
        points_room = wanted;
        grown_pieces = 0;
    }

    // Points and picture of the sizes the view asks for.
    void make_room(const FurView& view) {
        const vk::Extent2D extent{static_cast<std::uint32_t>(view.camera.width), static_cast<std::uint32_t>(view.camera.height)};
        make_points(static_cast<std::size_t>(coat.strands), view.layers);
        if (coat.pieces != view.layers) grown_pieces = 0;
        coat.pieces = view.layers;
        if (!target || target->extent != extent) {
            using Usage = vk::ImageUsageFlagBits;
            const std::size_t pixels = std::size_t{extent.width} * extent.height;
            target.reset();
            target = Target{.extent = extent,
                            .colour = gpu::make_image(device, colour_format, extent, 1, Usage::eColorAttachment | Usage::eTransferSrc),
                            .depth = gpu::make_image(device, depth_format, extent, 1, Usage::eDepthStencilAttachment | Usage::eSampled),
                            .seen = gpu::make_buffer(device, pixels * 8, vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferDst),
                            .tiles = gpu::make_device_buffer(device, tile_count(extent) * 4, vk::BufferUsageFlagBits::eStorageBuffer | vk::BufferUsageFlagBits::eTransferDst),
                            .texels = gpu::make_buffer(device, pixels * 4, vk::BufferUsageFlagBits::eTransferDst)};
        }
    }

    void describe() {
        sets = nullptr;
        sets = vk::raii::DescriptorSets(device.handle(), vk::DescriptorSetAllocateInfo{.descriptorPool = *pool, .descriptorSetCount = 1, .pSetLayouts = &*set_layout});
        const auto whole = [](const gpu::Buffer& b) { return vk::DescriptorBufferInfo{.buffer = *b.handle, .range = VK_WHOLE_SIZE}; };
        const vk::DescriptorBufferInfo uniforms = whole(coat_buffer), seen = whole(target->seen), tiles = whole(target->tiles), grown = whole(points);
        const vk::BufferView views[] = {*places_view, *natures_view, *points_view};
        const auto sampled = [](const vk::raii::Sampler& s, const gpu::Image& i) { return vk::DescriptorImageInfo{.sampler = *s, .imageView = *i.view, .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal}; };
        const vk::DescriptorImageInfo images[] = {sampled(volume_sampler, noise), sampled(light_sampler, light_depth), sampled(exact_sampler, target->depth)};
        using Type = vk::DescriptorType;
        std::vector<vk::WriteDescriptorSet> writes;
        const auto write = [&](std::uint32_t binding, Type type) -> vk::WriteDescriptorSet& { return writes.emplace_back(vk::WriteDescriptorSet{.dstSet = *sets[0], .dstBinding = binding, .descriptorCount = 1, .descriptorType = type}); };
        write(coat_binding, Type::eUniformBuffer).pBufferInfo = &uniforms;
        for (std::uint32_t b = places_binding; b <= points_binding; ++b) write(b, Type::eUniformTexelBuffer).pTexelBufferView = &views[b - places_binding];
        write(seen_binding, Type::eStorageBuffer).pBufferInfo = &seen;
        for (std::uint32_t b = noise_binding; b <= skin_binding; ++b) write(b, Type::eCombinedImageSampler).pImageInfo = &images[b - noise_binding];
        // Programs that look at no pushes must have something bound all the same.
        const vk::BufferView pushed = *pushes_view ? *pushes_view : *points_view;
        write(pushes_binding, Type::eUniformTexelBuffer).pTexelBufferView = &pushed;
        write(tiles_binding, Type::eStorageBuffer).pBufferInfo = &tiles;
        write(grown_binding, Type::eStorageBuffer).pBufferInfo = &grown;
        device.handle().updateDescriptorSets(writes, {});
    }

    void bind(const vk::raii::CommandBuffer& commands, vk::PipelineBindPoint point, const vk::raii::Pipeline& pipeline, const FurMatrices& push) const {
        commands.bindPipeline(point, *pipeline);
        commands.bindDescriptorSets(point, *layout, 0, {*sets[0]}, {});
        commands.pushConstants<FurMatrices>(*layout, vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment | vk::ShaderStageFlagBits::eCompute, 0, push);
    }
    void bind_drawing(const vk::raii::CommandBuffer& commands, const vk::raii::Pipeline& pipeline, const FurMatrices& push, vk::Extent2D extent) const {
        commands.setViewport(0, vk::Viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1});
        commands.setScissor(0, vk::Rect2D{{0, 0}, extent});
        bind(commands, vk::PipelineBindPoint::eGraphics, pipeline, push);
    }
    void draw_mesh(const vk::raii::CommandBuffer& commands) const {
        commands.bindVertexBuffers(0, {*vertices.handle}, {0});
        commands.bindIndexBuffer(*indices.handle, 0, vk::IndexType::eUint32);
        commands.drawIndexed(index_count, 1, 0, 0, 0);
    }
    void dispatch(const vk::raii::CommandBuffer& commands, const vk::raii::Pipeline& pipeline, const FurMatrices& push) const {
        bind(commands, vk::PipelineBindPoint::eCompute, pipeline, push);
        commands.dispatch(static_cast<std::uint32_t>((coat.strands + group_size - 1) / group_size), 1, 1);
    }

    void record_light(const vk::raii::CommandBuffer& commands, const FurMatrices& push) const {
        gpu::transition(commands, light_depth, vk::ImageLayout::eUndefined, vk::ImageLayout::eDepthAttachmentOptimal);
        const vk::RenderingAttachmentInfo nearest{.imageView = *light_depth.view,
                                                  .imageLayout = vk::ImageLayout::eDepthAttachmentOptimal,
                                                  .loadOp = vk::AttachmentLoadOp::eClear,
                                                  .storeOp = vk::AttachmentStoreOp::eStore,
                                                  .clearValue = vk::ClearDepthStencilValue{1, 0}};
        commands.beginRendering({.renderArea = {{0, 0}, light_depth.extent}, .layerCount = 1, .pDepthAttachment = &nearest});
        bind_drawing(commands, light, push, light_depth.extent);
        draw_mesh(commands);
        commands.endRendering();
        gpu::transition(commands, light_depth, vk::ImageLayout::eDepthAttachmentOptimal, vk::ImageLayout::eShaderReadOnlyOptimal);
    }

    void record_skin(const vk::raii::CommandBuffer& commands, const FurMatrices& push) const {
        const Target& t = *target;
        gpu::transition(commands, t.colour, vk::ImageLayout::eUndefined, vk::ImageLayout::eColorAttachmentOptimal);
        gpu::transition(commands, t.depth, vk::ImageLayout::eUndefined, vk::ImageLayout::eDepthAttachmentOptimal);
        const vk::RenderingAttachmentInfo into{.imageView = *t.colour.view,
                                               .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
                                               .loadOp = vk::AttachmentLoadOp::eClear,
                                               .storeOp = vk::AttachmentStoreOp::eStore,
                                               .clearValue = vk::ClearColorValue(std::array{0.0f, 0.0f, 0.0f, 0.0f})};
        const vk::RenderingAttachmentInfo nearest{.imageView = *t.depth.view,
                                                  .imageLayout = vk::ImageLayout::eDepthAttachmentOptimal,
                                                  .loadOp = vk::AttachmentLoadOp::eClear,
                                                  .storeOp = vk::AttachmentStoreOp::eStore,
                                                  .clearValue = vk::ClearDepthStencilValue{1, 0}};
        commands.beginRendering({.renderArea = {{0, 0}, t.extent}, .layerCount = 1, .colorAttachmentCount = 1, .pColorAttachments = &into, .pDepthAttachment = &nearest});
        bind_drawing(commands, skin, push, t.extent);
        draw_mesh(commands);
        commands.endRendering();
        gpu::transition(commands, t.depth, vk::ImageLayout::eDepthAttachmentOptimal, vk::ImageLayout::eShaderReadOnlyOptimal);
    }

    void record_shade(const vk::raii::CommandBuffer& commands, const FurMatrices& push) const {
        const Target& t = *target;
        const vk::RenderingAttachmentInfo onto{.imageView = *t.colour.view, .imageLayout = vk::ImageLayout::eColorAttachmentOptimal, .loadOp = vk::AttachmentLoadOp::eLoad, .storeOp = vk::AttachmentStoreOp::eStore};
        commands.beginRendering({.renderArea = {{0, 0}, t.extent}, .layerCount = 1, .colorAttachmentCount = 1, .pColorAttachments = &onto});
        bind_drawing(commands, shade, push, t.extent);
        commands.draw(tile_count(t.extent) * 6, 1, 0, 0);
        commands.endRendering();
    }

    FurStages draw_pass(const FurView& view, int pass) {
        const FurPass moved = fur_pass(view, pass, coat.fur_length);
        coat.sample_shift = moved.sample_shift;
        std::memcpy(coat_buffer.mapped, &coat, sizeof coat);
        device.run([&](const vk::raii::CommandBuffer& commands) {
            std::uint32_t stamp = 0;
            const auto mark = [&] { commands.writeTimestamp2(vk::PipelineStageFlagBits2::eAllCommands, *stamps, stamp++); };
            commands.resetQueryPool(*stamps, 0, 7);
            mark();
            if (lit_by != moved.light) record_light(commands, moved.light);
            mark();
            record_skin(commands, moved.eye);
            mark();
            commands.fillBuffer(*target->seen.handle, 0, VK_WHOLE_SIZE, 0xffffffffu);
            commands.fillBuffer(*target->tiles.handle, 0, VK_WHOLE_SIZE, 0);
            if (grown_pieces == 0) dispatch(commands, grow[(coat.curl_radius > 0 ? 1u : 0u) + (*pushes_view ? 2u : 0u)], moved.eye);
            gpu::full_barrier(commands);
            mark();
            dispatch(commands, plot, moved.eye);
            gpu::full_barrier(commands);
            mark();
            record_shade(commands, moved.eye);
            mark();
            gpu::transition(commands, target->colour, vk::ImageLayout::eColorAttachmentOptimal, vk::ImageLayout::eTransferSrcOptimal);
            gpu::read_back(commands, target->colour, target->texels);
            mark();
        });
        grown_pieces = coat.pieces;
        lit_by = moved.light;
        const auto [result, ticks] = stamps.getResults<std::uint64_t>(0, 7, 7 * 8, 8, vk::QueryResultFlagBits::e64 | vk::QueryResultFlagBits::eWait);
        if (result != vk::Result::eSuccess) throw Error("time", "a frame on " + device.info().name, vk::to_string(result));
        const auto ms = [&](std::size_t i) { return static_cast<double>(ticks[i + 1] - ticks[i]) * device.nanoseconds_per_tick() * 1e-6; };
        return {.light = ms(0), .skin = ms(1), .grow = ms(2), .plot = ms(3), .shade = ms(4), .copy = ms(5)};
    }
};

StrandRenderer::StrandRenderer(const std::string& device, bool validation)
    : state_(gpu::vulkan_errors_as("start", "the device", [&] { return std::make_unique<State>(device, validation); })) {
    // Drivers translate programs when they first run, which takes longer than many frames: three strands on a triangle are drawn once, while
    // whoever starts a renderer is still reading a mesh.
    Mesh triangle;
    triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    triangle.normals = std::vector<Vec3f>(3, {0, 0, 1});
    triangle.indices = {0, 1, 2};
    const std::vector<Vec3f> comb(3);
    const RootedStrands strand{.places = std::vector<RootedStrands::Place>(3), .natures = std::vector<RootedStrands::Nature>(3)};
    load({.mesh = &triangle, .comb = &comb, .strands = &strand});
    // No power of two among the sides of the picture, the strands and their points: llvmpipe has other programs for those.
    draw({.camera = view_of_sphere({0, 0, 0}, 1, 24, 20), .layers = 2, .passes = 1});
}
StrandRenderer::~StrandRenderer() = default;

std::string StrandRenderer::device_name() const { return state_->device.info().name; }
std::vector<std::string> StrandRenderer::validation_messages() const { return state_->device.validation_messages(); }

void StrandRenderer::expect(const FurView& view, std::size_t strands) {
    State& s = *state_;
    FurView once = view;
    once.passes = 1;
    draw(once);  // the three strands of the constructor: the device's own images are touched by drawing only
    gpu::vulkan_errors_as("draw", "fur", [&] { s.make_points(strands, view.layers); });
    s.empty.colour = ImageF(view.camera.width, view.camera.height, 3);
    s.empty.coverage = ImageF(view.camera.width, view.camera.height, 1);
    std::memset(s.points.mapped, 0, s.points.size);
    std::memset(s.target->seen.mapped, 0, s.target->seen.size);
}

void StrandRenderer::load(const StrandModel& model) {
    gpu::vulkan_errors_as("load", model.mesh->name, [&] { state_->load(model); });
}

void StrandRenderer::push(std::span<const std::array<float, 4>> strands, std::span<const Vec3f> vertices) {
    State& s = *state_;
    assert(strands.size() == static_cast<std::size_t>(s.coat.strands) && vertices.size() == s.vertex_count);
    // Fur that nothing bends is drawn by the programs that know of no forces, which are exact.
    s.pushes_view = nullptr;
    if (std::ranges::any_of(strands, [](const std::array<float, 4>& p) { return p != std::array<float, 4>{}; }))
        gpu::vulkan_errors_as("bend", "fur", [&] { s.texels(s.pushes, s.pushes_view, strands, vk::Format::eR32G32B32A32Sfloat); });
    auto* to = s.vertices.as<Vertex>();
    for (std::size_t v = 0; v < vertices.size(); ++v) to[v].push = vertices[v];
    s.grown_pieces = 0;
    s.lit_by.reset();
}

FurFrames StrandRenderer::draw(const FurView& view) {
    State& s = *state_;
    const MeshView& camera = view.camera;
    assert(view.layers >= 1 && view.passes >= 1 && s.index_count > 0);
    const auto limit = static_cast<int>(s.device.physical().getProperties().limits.maxFramebufferWidth);
    if (camera.width < 1 || camera.height < 1 || camera.width > limit || camera.height > limit)
        throw Error("draw", "a picture of " + std::to_string(camera.width) + " x " + std::to_string(camera.height),
                    s.device.info().name + " draws 1 to " + std::to_string(limit) + " pixels a side");
    return gpu::vulkan_errors_as("draw", "fur", [&] {
        s.make_room(view);
        s.describe();
        set_view(s.coat, view);
        s.coat.thinnest = view.passes == 1 ? 1.0f : 0.3f;
        FurFrames frames = std::exchange(s.empty, {});
        if (frames.colour.width != camera.width || frames.colour.height != camera.height) {
            frames.colour = ImageF(camera.width, camera.height, 3);
            frames.coverage = ImageF(camera.width, camera.height, 1);
        }
        for (int pass = 0; pass < view.passes; ++pass) {
            const auto start = std::chrono::steady_clock::now();
            frames.stages.push_back(s.draw_pass(view, pass));
            add_pass(frames, {s.target->texels.as<std::uint8_t>(), s.target->texels.size}, view.passes);
            frames.frame_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        }
        return frames;
    });
}

}  // namespace relievo
