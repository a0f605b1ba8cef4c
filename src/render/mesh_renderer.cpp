#include "render/mesh_renderer.h"

#include "core/error.h"
#include "gpu/buffer.h"
#include "gpu/image.h"
#include "gpu/pipeline.h"
#include "gpu/vertex_counter.h"
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

struct Vertex {
    Vec3f position, normal;
};

// shaders/hosts/mesh/phong.glsl
struct Push {
    std::array<float, 16> to_clip;
    std::array<float, 4> eye, to_light;
};
static_assert(sizeof(Push) == 96);

// Clip space has y down the screen and depth from 0 at the near plane to 1 at the far one. Columns first.
Push push_of(const MeshView& view) {
    const Camera::Axes axes = view.camera.axes();
    const double up = 1 / std::tan(view.camera.fov_y_rad / 2), across = up * view.height / view.width;
    const double depth = view.far / (view.far - view.near);
    const Vec3d rows[4] = {axes.right * across, axes.up * -up, axes.back * -depth, axes.back * -1.0};
    Push push;
    for (std::size_t r = 0; r < 4; ++r) {
        const double offset = -dot(rows[r], view.camera.eye) - (r == 2 ? depth * view.near : 0);
        const double row[4] = {rows[r].x, rows[r].y, rows[r].z, offset};
        for (std::size_t c = 0; c < 4; ++c) push.to_clip[c * 4 + r] = static_cast<float>(row[c]);
    }
    const Vec3d light = normalize(axes.back + axes.up * 0.8 - axes.right * 0.6);
    const auto four = [](Vec3d v) { return std::array{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0.0f}; };
    push.eye = four(view.camera.eye);
    push.to_light = four(light);
    return push;
}

// A form on the device.
struct Uploaded {
    gpu::Buffer vertices, indices;
    std::uint32_t count = 0;
    std::optional<vk::IndexType> type;
};

Uploaded upload(const gpu::Device& device, const MeshForm& form) {
    const Mesh& mesh = *form.mesh;
    Uploaded u;
    u.count = static_cast<std::uint32_t>(mesh.indices.size());
    const auto vertex = [&](std::size_t v) { return Vertex{mesh.positions[v], mesh.normals.empty() ? Vec3f{} : mesh.normals[v]}; };
    const std::size_t vertices = form.as_list ? mesh.indices.size() : mesh.positions.size();
    u.vertices = gpu::make_buffer(device, vertices * sizeof(Vertex), vk::BufferUsageFlagBits::eVertexBuffer);
    for (std::size_t i = 0; i < vertices; ++i) u.vertices.as<Vertex>()[i] = vertex(form.as_list ? mesh.indices[i] : i);
    if (form.as_list) return u;
    const bool small = mesh.positions.size() < 65536;
    u.type = small ? vk::IndexType::eUint16 : vk::IndexType::eUint32;
    u.indices = gpu::make_buffer(device, mesh.indices.size() * (small ? 2 : 4), vk::BufferUsageFlagBits::eIndexBuffer);
    if (small) {
        std::ranges::transform(mesh.indices, u.indices.as<std::uint16_t>(), [](std::uint32_t i) { return static_cast<std::uint16_t>(i); });
    } else {
        std::ranges::copy(mesh.indices, u.indices.as<std::uint32_t>());
    }
    return u;
}

}  // namespace

MeshView view_of_sphere(Vec3d centre, double radius, int width, int height) {
    MeshView view{.width = width, .height = height};
    radius = radius > 0 ? radius : 1;
    view.camera.fov_y_rad = 0.6;
    view.camera.up = {0, 1, 0};
    view.camera.target = centre;
    const double half = std::min(0.3, std::atan(std::tan(0.3) * width / height));  // of the narrower angle of view
    const double distance = radius / std::sin(half) * 1.02;
    view.camera.eye = centre + normalize(Vec3d(0.45, 0.35, 1)) * distance;
    view.near = distance - radius * 1.01;
    view.far = distance + radius * 1.01;
    return view;
}

struct MeshRenderer::State {
    gpu::Device device;
    vk::raii::PipelineLayout layout = nullptr;
    vk::raii::Pipeline pipeline = nullptr;

    State(const std::string& choice, bool validation) : device(gpu::DeviceSettings{.choice = choice, .validation = validation}) {
        const vk::PushConstantRange range{.stageFlags = vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, .size = sizeof(Push)};
        layout = vk::raii::PipelineLayout(device.handle(), vk::PipelineLayoutCreateInfo{.pushConstantRangeCount = 1, .pPushConstantRanges = &range});
        const vk::VertexInputAttributeDescription attributes[] = {
            {.location = 0, .format = vk::Format::eR32G32B32Sfloat, .offset = offsetof(Vertex, position)},
            {.location = 1, .format = vk::Format::eR32G32B32Sfloat, .offset = offsetof(Vertex, normal)}};
        pipeline = gpu::make_pipeline(device, *layout,
                                      gpu::DrawPipeline{.vertex = program_words("mesh/phong.vert"),
                                                        .fragment = program_words("mesh/phong.frag"),
                                                        .targets = std::span(&colour_format, 1),
                                                        .attributes = attributes,
                                                        .vertex_bytes = sizeof(Vertex),
                                                        .depth = depth_format});
    }

    void record(const vk::raii::CommandBuffer& commands, const Uploaded& form, const Push& push, const gpu::Image& colour, const gpu::Image& depth,
                const gpu::VertexCounter* counter) const {
        gpu::transition(commands, colour, vk::ImageLayout::eUndefined, vk::ImageLayout::eColorAttachmentOptimal);
        gpu::transition(commands, depth, vk::ImageLayout::eUndefined, vk::ImageLayout::eDepthAttachmentOptimal);
        if (counter) counter->reset(commands);
        const vk::RenderingAttachmentInfo into{.imageView = *colour.view,
                                               .imageLayout = vk::ImageLayout::eColorAttachmentOptimal,
                                               .loadOp = vk::AttachmentLoadOp::eClear,
                                               .storeOp = vk::AttachmentStoreOp::eStore,
                                               .clearValue = vk::ClearColorValue(std::array{0.72f, 0.76f, 0.82f, 1.0f})};
        const vk::RenderingAttachmentInfo nearest{.imageView = *depth.view,
                                                  .imageLayout = vk::ImageLayout::eDepthAttachmentOptimal,
                                                  .loadOp = vk::AttachmentLoadOp::eClear,
                                                  .storeOp = vk::AttachmentStoreOp::eDontCare,
                                                  .clearValue = vk::ClearDepthStencilValue{1, 0}};
        const vk::Rect2D area{{0, 0}, colour.extent};
        commands.beginRendering({.renderArea = area, .layerCount = 1, .colorAttachmentCount = 1, .pColorAttachments = &into, .pDepthAttachment = &nearest});
        commands.setViewport(0, vk::Viewport{0, 0, static_cast<float>(area.extent.width), static_cast<float>(area.extent.height), 0, 1});
        commands.setScissor(0, area);
        commands.bindPipeline(vk::PipelineBindPoint::eGraphics, *pipeline);
        commands.pushConstants<Push>(*layout, vk::ShaderStageFlagBits::eVertex | vk::ShaderStageFlagBits::eFragment, 0, push);
        commands.bindVertexBuffers(0, {*form.vertices.handle}, {0});
        if (counter) counter->start(commands);
        if (form.type) {
            commands.bindIndexBuffer(*form.indices.handle, 0, *form.type);
            commands.drawIndexed(form.count, 1, 0, 0, 0);
        } else {
            commands.draw(form.count, 1, 0, 0);
        }
        if (counter) counter->stop(commands);
        commands.endRendering();
    }
};

MeshRenderer::MeshRenderer(const std::string& device, bool validation) : state_(std::make_unique<State>(device, validation)) {}
MeshRenderer::~MeshRenderer() = default;

std::string MeshRenderer::device_name() const { return state_->device.info().name; }
std::vector<std::string> MeshRenderer::validation_messages() const { return state_->device.validation_messages(); }

std::vector<MeshFrames> MeshRenderer::draw(std::span<const MeshForm> forms, const MeshView& view, int runs) {
    const gpu::Device& device = state_->device;
    const auto limit = static_cast<int>(device.physical().getProperties().limits.maxFramebufferWidth);
    if (view.width < 1 || view.height < 1 || view.width > limit || view.height > limit)
        throw Error("draw", "a picture of " + std::to_string(view.width) + " x " + std::to_string(view.height),
                    device.info().name + " draws 1 to " + std::to_string(limit) + " pixels a side");
    const vk::Extent2D extent{static_cast<std::uint32_t>(view.width), static_cast<std::uint32_t>(view.height)};
    const gpu::Image colour = gpu::make_image(device, colour_format, extent, 1, vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc);
    const gpu::Image depth = gpu::make_image(device, depth_format, extent, 1, vk::ImageUsageFlagBits::eDepthStencilAttachment);
    const std::size_t pixels = std::size_t{extent.width} * extent.height;
    const gpu::Buffer texels = gpu::make_buffer(device, pixels * 4, vk::BufferUsageFlagBits::eTransferDst);
    const Push push = push_of(view);
    std::optional<gpu::VertexCounter> counter;
    if (device.counts_vertices()) counter.emplace(device);

    std::vector<Uploaded> uploaded;
    std::vector<MeshFrames> frames(forms.size());
    for (std::size_t i = 0; i < forms.size(); ++i) {
        assert(forms[i].mesh != nullptr && forms[i].mesh->faces() > 0);
        uploaded.push_back(upload(device, forms[i]));
        device.run([&](const vk::raii::CommandBuffer& commands) {
            state_->record(commands, uploaded[i], push, colour, depth, counter ? &*counter : nullptr);
            gpu::transition(commands, colour, vk::ImageLayout::eColorAttachmentOptimal, vk::ImageLayout::eTransferSrcOptimal);
            gpu::read_back(commands, colour, texels);
        });
        frames[i].vertex_invocations =
            counter ? Measured<std::uint64_t>(counter->invocations()) : Measured<std::uint64_t>::missing(device.info().name + " does not count vertices");
        frames[i].picture = Image8(view.width, view.height, 3);
        for (std::size_t p = 0; p < pixels; ++p) std::memcpy(&frames[i].picture.texels[p * 3], texels.as<std::uint8_t>() + p * 4, 3);
    }
    std::vector<std::vector<double>> times(forms.size());
    for (int run = 0; run < runs; ++run)
        for (std::size_t i = 0; i < forms.size(); ++i) {
            const auto start = std::chrono::steady_clock::now();
            device.run([&](const vk::raii::CommandBuffer& commands) { state_->record(commands, uploaded[i], push, colour, depth, nullptr); });
            times[i].push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
        }
    for (std::size_t i = 0; runs > 0 && i < forms.size(); ++i) {
        std::ranges::sort(times[i]);
        frames[i].frame_ms = {times[i].front(), times[i][times[i].size() / 2], times[i].back(), runs};
        frames[i].frames_per_second = 1000 / frames[i].frame_ms.median;
    }
    return frames;
}

}  // namespace relievo
