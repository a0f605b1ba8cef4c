#include "render/layers_renderer.h"

#include "core/error.h"
#include "core/parallel_for.h"
#include "gpu/buffer.h"
#include "gpu/image.h"
#include "gpu/pipeline.h"
#include "render/eye_matrix.h"
#include "render/programs.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cstddef>
#include <cstring>

namespace relievo {

namespace {

#include "shared/layers.h"
static_assert(sizeof(LayersUniforms) == 17 * 4 && offsetof(LayersUniforms, skin_r) == 12 * 4, "shaders/shared/layers.h without holes");
static_assert(lookup_cube == static_cast<int>(MapShape::cube) && lookup_sphere == static_cast<int>(MapShape::sphere));
static_assert(addressing_normal == static_cast<int>(Addressing::normal) && addressing_position == static_cast<int>(Addressing::position) &&
              addressing_sum == static_cast<int>(Addressing::normal_plus_position));

constexpr vk::Format colour_format = vk::Format::eR8G8B8A8Srgb;
constexpr vk::Format depth_format = vk::Format::eD32Sfloat;

struct Vertex {
    Vec3f position, normal;
};

struct CombedVertex {
    Vec3f position, normal, comb;
    Vec2f uv;
};

// Plain meshes, whose strands stand upright; meshes that are combed; and those of lapped patches.
enum class Form { upright, combed, lapped };
constexpr std::array forms{Form::upright, Form::combed, Form::lapped};

struct Push {
    std::array<float, 16> to_clip;
    std::int32_t first_layer;
};

gpu::Image uploaded(const gpu::Device& device, const DirectionMap& map) {
    const auto size = static_cast<std::uint32_t>(map.size());
    const auto write_row = [&](int level, int y, std::byte* out) {
        // Rows of a level go on from face to face.
        const int edge = std::max(1, map.size() >> level);
        const Image8& texels = map.faces[static_cast<std::size_t>(y / edge)][static_cast<std::size_t>(level)];
        std::memcpy(out, texels.at(0, y % edge), static_cast<std::size_t>(edge) * 4);
    };
    return gpu::make_texture(device, map.colours ? vk::Format::eR8G8B8A8Srgb : vk::Format::eR8G8B8A8Unorm, {size, size}, static_cast<std::uint32_t>(map.faces.front().size()), 4,
                             write_row, map.shape == MapShape::cube ? gpu::cube_layers : 0);
}

// A single transparent texel, where a program has a texture it does not read.
DirectionMap nothing(MapShape shape) {
    const int faces = shape == MapShape::cube ? 6 : 1;
    return {.shape = shape, .colours = false, .faces = std::vector(static_cast<std::size_t>(faces), std::vector{Image8(1, 1, 4)})};
}

}  // namespace

struct LayersRenderer::State {
    gpu::Device device;
    vk::raii::DescriptorSetLayout set_layout = nullptr;
    vk::raii::PipelineLayout layout = nullptr;
    std::array<vk::raii::Pipeline, forms.size()> skins{nullptr, nullptr, nullptr};
    vk::raii::Pipeline layers = nullptr;  // made for each model
    vk::raii::Sampler sampler = nullptr;
    gpu::Buffer uniforms_buffer;
    vk::raii::DescriptorPool pool = nullptr;

    // The model.
    gpu::Buffer vertices, indices;
    std::array<gpu::Image, 4> textures;  // fur and colour as cubes, then as discs
    vk::raii::DescriptorSets sets = nullptr;
    std::uint32_t index_count = 0;
    Form form = Form::upright;
    LayersUniforms uniforms{};

    static constexpr auto stages = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment;
    static constexpr vk::VertexInputAttributeDescription attributes[] = {{.location = 0, .format = vk::Format::eR32G32B32Sfloat, .offset = offsetof(Vertex, position)},
                                                                         {.location = 1, .format = vk::Format::eR32G32B32Sfloat, .offset = offsetof(Vertex, normal)}};
    static constexpr vk::VertexInputAttributeDescription combed_attributes[] = {{.location = 0, .format = vk::Format::eR32G32B32Sfloat, .offset = offsetof(CombedVertex, position)},
                                                                                {.location = 1, .format = vk::Format::eR32G32B32Sfloat, .offset = offsetof(CombedVertex, normal)},
                                                                                {.location = 2, .format = vk::Format::eR32G32B32Sfloat, .offset = offsetof(CombedVertex, comb)},
                                                                                {.location = 3, .format = vk::Format::eR32G32Sfloat, .offset = offsetof(CombedVertex, uv)}};

    // With the vertices of the form.
    gpu::DrawPipeline program(Form of, std::string_view fragment) const {
        const bool combed = of != Form::upright;
        const std::span<const vk::VertexInputAttributeDescription> all = combed_attributes;
        return {.vertex = program_words(of == Form::upright ? "shells/layers.vert" : of == Form::combed ? "shells/layers_combed.vert" : "shells/lapped.vert"),
                .fragment = program_words(fragment),
                .targets = std::span(&colour_format, 1),
                .attributes = of == Form::lapped ? all : combed ? all.first(3) : attributes,
                .vertex_bytes = static_cast<std::uint32_t>(combed ? sizeof(CombedVertex) : sizeof(Vertex)),
                .depth = depth_format};
    }

    State(const std::string& choice, bool validation) : device(gpu::DeviceSettings{.choice = choice, .validation = validation}) {
        using Type = vk::DescriptorType;
        std::vector<vk::DescriptorSetLayoutBinding> bindings{{.binding = 0, .descriptorType = Type::eUniformBuffer, .descriptorCount = 1, .stageFlags = stages}};
        for (std::uint32_t b = 1; b <= 4; ++b)
            bindings.push_back({.binding = b, .descriptorType = Type::eCombinedImageSampler, .descriptorCount = 1, .stageFlags = vk::ShaderStageFlagBits::eFragment});
        set_layout = {device.handle(), vk::DescriptorSetLayoutCreateInfo{.bindingCount = static_cast<std::uint32_t>(bindings.size()), .pBindings = bindings.data()}};
        const vk::PushConstantRange range{.stageFlags = stages, .size = sizeof(Push)};
        layout = {device.handle(), vk::PipelineLayoutCreateInfo{.setLayoutCount = 1, .pSetLayouts = &*set_layout, .pushConstantRangeCount = 1, .pPushConstantRanges = &range}};
        for (const Form of : forms) skins[static_cast<std::size_t>(of)] = gpu::make_pipeline(device, *layout, program(of, "shells/layers_skin.frag"));
        sampler = {device.handle(), vk::SamplerCreateInfo{.magFilter = vk::Filter::eLinear,
                                                          .minFilter = vk::Filter::eLinear,
                                                          .mipmapMode = vk::SamplerMipmapMode::eLinear,
                                                          .addressModeU = vk::SamplerAddressMode::eClampToEdge,
                                                          .addressModeV = vk::SamplerAddressMode::eClampToEdge,
                                                          .maxLod = VK_LOD_CLAMP_NONE}};
        uniforms_buffer = gpu::make_buffer(device, sizeof(LayersUniforms), vk::BufferUsageFlagBits::eUniformBuffer);
        const vk::DescriptorPoolSize sizes[] = {{Type::eUniformBuffer, 1}, {Type::eCombinedImageSampler, 4}};
        pool = {device.handle(), vk::DescriptorPoolCreateInfo{.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, .maxSets = 1, .poolSizeCount = 2, .pPoolSizes = sizes}};
    }

    void load(const LayersModel& model) {
        const Mesh& mesh = *model.mesh;
        assert(mesh.normals.size() == mesh.positions.size() && mesh.faces() > 0 && model.fur->shape == model.colour->shape);
        const auto edge = device.physical().getProperties().limits.maxImageDimensionCube;
        if (model.fur->size() > static_cast<int>(edge) || model.colour->size() > static_cast<int>(edge))
            throw Error("draw", "a fur map of " + std::to_string(model.fur->size()) + " texels a side", device.info().name + " reads no more than " + std::to_string(edge));
        form = !model.comb ? Form::upright : mesh.uvs.empty() ? Form::combed : Form::lapped;
        const bool lapped = form == Form::lapped;
        assert(!model.comb || model.comb->size() == mesh.positions.size());
        assert(!lapped || (mesh.uvs.size() == mesh.positions.size() && model.fur->shape == MapShape::sphere));
        vertices = gpu::make_buffer(device, mesh.positions.size() * (model.comb ? sizeof(CombedVertex) : sizeof(Vertex)), vk::BufferUsageFlagBits::eVertexBuffer);
        parallel_for(static_cast<int>(mesh.positions.size()), 65536, 0, [&](int begin, int end) {
            for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v)
                if (model.comb)
                    vertices.as<CombedVertex>()[v] = {mesh.positions[v], mesh.normals[v], (*model.comb)[v], lapped ? mesh.uvs[v] : Vec2f()};
                else
                    vertices.as<Vertex>()[v] = {mesh.positions[v], mesh.normals[v]};
        });
        index_count = static_cast<std::uint32_t>(mesh.indices.size());
        indices = gpu::make_buffer(device, mesh.indices.size() * 4, vk::BufferUsageFlagBits::eIndexBuffer);
        std::ranges::copy(mesh.indices, indices.as<std::uint32_t>());

        sets = nullptr;
        const bool cube = model.fur->shape == MapShape::cube;
        const DirectionMap no_cube = nothing(MapShape::cube), no_disc = nothing(MapShape::sphere);
        const DirectionMap* maps[] = {cube ? model.fur : &no_cube, cube ? model.colour : &no_cube, cube ? &no_disc : model.fur, cube ? &no_disc : model.colour};
        for (std::size_t t = 0; t < textures.size(); ++t) textures[t] = uploaded(device, *maps[t]);
        sets = vk::raii::DescriptorSets(device.handle(), vk::DescriptorSetAllocateInfo{.descriptorPool = *pool, .descriptorSetCount = 1, .pSetLayouts = &*set_layout});
        const vk::DescriptorBufferInfo buffer{.buffer = *uniforms_buffer.handle, .range = VK_WHOLE_SIZE};
        std::array<vk::DescriptorImageInfo, 4> images;
        std::vector<vk::WriteDescriptorSet> writes{{.dstSet = *sets[0], .dstBinding = 0, .descriptorCount = 1, .descriptorType = vk::DescriptorType::eUniformBuffer, .pBufferInfo = &buffer}};
        for (std::uint32_t t = 0; t < 4; ++t) {
            images[t] = {.sampler = *sampler, .imageView = *textures[t].view, .imageLayout = vk::ImageLayout::eShaderReadOnlyOptimal};
            writes.push_back({.dstSet = *sets[0], .dstBinding = 1 + t, .descriptorCount = 1, .descriptorType = vk::DescriptorType::eCombinedImageSampler, .pImageInfo = &images[t]});
        }
        device.handle().updateDescriptorSets(writes, {});

        const std::uint32_t constants[] = {static_cast<std::uint32_t>(model.fur->shape), static_cast<std::uint32_t>(model.addressing), model.filtered};
        gpu::DrawPipeline blended = program(form, lapped ? "shells/lapped.frag" : "shells/layers.frag");
        if (!lapped) blended.fragment_constants = constants;
        blended.blended = true;
        layers = gpu::make_pipeline(device, *layout, blended);
        uniforms = {};
        uniforms.fur_height = model.height;
        uniforms.tilt = model.tilt;
        uniforms.bend = model.bend;
        uniforms.skin_r = model.skin.x;
        uniforms.skin_g = model.skin.y;
        uniforms.skin_b = model.skin.z;
        set_light(model.light);
    }

    void set_light(const LayersLight& light) {
        uniforms.ambient = light.ambient;
        uniforms.diffuse = light.diffuse;
        uniforms.specular = light.specular;
        uniforms.power = light.power;
    }

    void bind(const vk::raii::CommandBuffer& commands, const vk::raii::Pipeline& pipeline, const Push& push) const {
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline);
        commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *layout, 0, {*sets[0]}, {});
        commands.pushConstants<Push>(*layout, stages, 0, push);
        commands.bindVertexBuffers(0, {*vertices.handle}, {0});
        commands.bindIndexBuffer(*indices.handle, 0, vk::IndexType::eUint32);
    }
};

LayersRenderer::LayersRenderer(const std::string& device, bool validation)
    : state_(gpu::vulkan_errors_as("start", "the device", [&] { return std::make_unique<State>(device, validation); })) {}
LayersRenderer::~LayersRenderer() = default;

std::string LayersRenderer::device_name() const { return state_->device.info().name; }
std::vector<std::string> LayersRenderer::validation_messages() const { return state_->device.validation_messages(); }

void LayersRenderer::load(const LayersModel& model) {
    gpu::vulkan_errors_as("load", model.mesh->name, [&] { state_->load(model); });
}

void LayersRenderer::set_light(const LayersLight& light) { state_->set_light(light); }

FurFrames LayersRenderer::draw(const FurView& view) {
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
        const gpu::Image colour = gpu::make_image(s.device, colour_format, extent, 1, Usage::eColorAttachment | Usage::eTransferSrc);
        const gpu::Image depth = gpu::make_image(s.device, depth_format, extent, 1, Usage::eDepthStencilAttachment);
        const std::size_t bytes = std::size_t{extent.width} * extent.height * 4;
        const gpu::Buffer texels = gpu::make_buffer(s.device, bytes, vk::BufferUsageFlagBits::eTransferDst);
        const Vec3d key = normalize(view.to_key), eye = camera.camera.eye;
        s.uniforms.layers = view.layers;
        s.uniforms.eye_x = static_cast<float>(eye.x);
        s.uniforms.eye_y = static_cast<float>(eye.y);
        s.uniforms.eye_z = static_cast<float>(eye.z);
        s.uniforms.key_x = static_cast<float>(key.x);
        s.uniforms.key_y = static_cast<float>(key.y);
        s.uniforms.key_z = static_cast<float>(key.z);
        std::memcpy(s.uniforms_buffer.mapped, &s.uniforms, sizeof s.uniforms);

        FurFrames frames;
        frames.colour = ImageF(camera.width, camera.height, 3);
        frames.coverage = ImageF(camera.width, camera.height, 1);
        for (int pass = 0; pass < view.passes; ++pass) {
            const auto start = std::chrono::steady_clock::now();
            const Vec2d r = quasirandom(pass);
            const std::array<float, 16> to_clip = eye_matrix(camera, view.passes == 1 ? Vec2d{} : Vec2d(r.x - 0.5, r.y - 0.5));
            s.device.run([&](const vk::raii::CommandBuffer& commands) {
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
                commands.setViewport(0, vk::Viewport{0, 0, static_cast<float>(extent.width), static_cast<float>(extent.height), 0, 1});
                commands.setScissor(0, vk::Rect2D{{0, 0}, extent});
                s.bind(commands, s.skins[static_cast<std::size_t>(s.form)], {to_clip, 0});
                commands.drawIndexed(s.index_count, 1, 0, 0, 0);
                if (s.uniforms.fur_height > 0) {
                    s.bind(commands, s.layers, {to_clip, 1});
                    commands.drawIndexed(s.index_count, static_cast<std::uint32_t>(view.layers), 0, 0, 0);
                }
                commands.endRendering();
                gpu::transition(commands, colour, vk::ImageLayout::eColorAttachmentOptimal, vk::ImageLayout::eTransferSrcOptimal);
                gpu::read_back(commands, colour, texels);
            });
            add_pass(frames, {texels.as<std::uint8_t>(), bytes}, view.passes);
            frames.frame_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        }
        return frames;
    });
}

}  // namespace relievo
