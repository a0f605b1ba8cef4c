#include "render/gpu_renderer.h"

#include "core/error.h"
#include "gpu/stopwatch.h"
#include "render/heightfield_pass.h"

#include <algorithm>
#include <cassert>

namespace relievo {

namespace {

using F = vk::Format;
const FragmentHost shade_host{"shade.frag", {F::eR32G32B32A32Sfloat}};
const FragmentHost record_host{"record.frag", {F::eR32G32B32A32Sfloat, F::eR32G32B32A32Sfloat, F::eR32Sfloat}};
const FragmentHost rays_host{"rays.frag", {F::eR32G32B32A32Sfloat, F::eR32G32B32A32Sfloat}};

// The planes that record.frag writes, as a Frame without colour.
Frame frame_of(const std::vector<const float*>& facts, int width, int height) {
    Frame frame(width, height);
    for (std::size_t i = 0; i < frame.coverage.texels.size(); ++i) {
        const float* a = facts[0] + 4 * i;
        const float* b = facts[1] + 4 * i;
        frame.coverage.texels[i] = static_cast<std::uint8_t>(a[3]);
        if (frame.coverage.texels[i] != static_cast<std::uint8_t>(Coverage::hit)) continue;
        frame.hit_uv.texels[2 * i] = a[0];
        frame.hit_uv.texels[2 * i + 1] = a[1];
        frame.hit_height.texels[i] = a[2];
        std::copy_n(b, 3, frame.normal.texels.begin() + static_cast<std::ptrdiff_t>(3 * i));
        frame.shadow.texels[i] = b[3];
        frame.fetches.texels[i] = facts[2][i];
    }
    return frame;
}

}  // namespace

struct GpuRenderer::State {
    gpu::Device device;
    HeightFieldPass pass;
    SceneBinding scene;
    std::map<const FragmentHost*, TargetSet> targets;  // of the last size drawn

    State(const std::string& choice, bool validation)
        : device(gpu::DeviceSettings{.choice = choice, .validation = validation}), pass(device), scene(device, pass.layout()) {}

    TargetSet& targets_of(const FragmentHost& host, int width, int height) {
        const auto limit = static_cast<int>(device.physical().getProperties().limits.maxFramebufferWidth);
        if (width < 1 || height < 1 || width > limit || height > limit)
            throw Error("draw", "a picture of " + std::to_string(width) + " x " + std::to_string(height),
                        device.info().name + " draws 1 to " + std::to_string(limit) + " pixels a side");
        const vk::Extent2D extent{static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
        auto it = targets.find(&host);
        if (it == targets.end() || it->second.extent != extent)
            it = targets.insert_or_assign(&host, make_targets(device, host, width, height)).first;
        return it->second;
    }

    // Draws and, if asked, reads every target back: four floats or one a pixel, which live until the next draw of the same host.
    // A stopwatch measures the pass alone, without the reading.
    std::vector<const float*> draw(const HeightFieldPass::Draw& what, int width, int height, bool read = true,
                                   const gpu::Stopwatch* stopwatch = nullptr, double* ms = nullptr) {
        TargetSet& to = targets_of(what.host, width, height);
        if (to.read.empty())
            for (const gpu::Image& image : to.images)
                to.read.push_back(gpu::make_buffer(
                    device, vk::DeviceSize{to.extent.width} * to.extent.height * (image.format == F::eR32Sfloat ? 4 : 16),
                    vk::BufferUsageFlagBits::eTransferDst));
        pass.pipeline(what);
        device.run([&](const vk::raii::CommandBuffer& commands) {
            std::vector<vk::ImageView> views;
            for (const gpu::Image& image : to.images) {
                gpu::transition(commands, image, vk::ImageLayout::eUndefined, vk::ImageLayout::eColorAttachmentOptimal);
                views.push_back(*image.view);
            }
            if (stopwatch != nullptr) stopwatch->start(commands);
            pass.record(commands, what, views, to.extent);
            if (stopwatch != nullptr) stopwatch->stop(commands);
            for (std::size_t i = 0; read && i < to.images.size(); ++i) {
                gpu::transition(commands, to.images[i], vk::ImageLayout::eColorAttachmentOptimal,
                                vk::ImageLayout::eTransferSrcOptimal);
                gpu::read_back(commands, to.images[i], to.read[i]);
            }
        });
        if (stopwatch != nullptr) *ms = stopwatch->elapsed_ms();
        std::vector<const float*> planes;
        for (const gpu::Buffer& buffer : to.read) planes.push_back(buffer.as<const float>());
        return planes;
    }
};

std::vector<GpuDevice> gpu_devices() {
    std::vector<GpuDevice> devices;
    for (const gpu::DeviceInfo& d : gpu::list_devices()) devices.push_back({d.name, d.driver, d.software, d.lacks});
    return devices;
}

GpuRenderer::GpuRenderer(const std::string& device, bool validation)
    : state_(gpu::vulkan_errors_as("start", "the renderer", [&] { return std::make_unique<State>(device, validation); })) {}

GpuRenderer::~GpuRenderer() = default;

std::string GpuRenderer::device_name() const { return state_->device.info().name; }
std::string GpuRenderer::driver() const { return state_->device.info().driver; }
std::vector<std::string> GpuRenderer::validation_messages() const { return state_->device.validation_messages(); }

std::shared_ptr<const GpuMaterial> GpuRenderer::upload(const MapSet& maps, float height_scale, float zero_level) {
    return gpu::vulkan_errors_as("upload", "the material to " + device_name(), [&] {
        return std::make_shared<const GpuMaterial>(state_->device, state_->pass.layout(), maps, height_scale, zero_level);
    });
}

RayField GpuRenderer::rays(const Stage& stage, const GpuMaterial& material, int width, int height, Vec2f offset) {
    return gpu::vulkan_errors_as("draw", "rays on " + device_name(), [&] {
        state_->scene.update(stage, width, height, offset);
        const auto planes = state_->draw({.host = rays_host, .material = material, .scene = state_->scene}, width, height);
        RayField rays(width, height);
        for (std::size_t i = 0; i < rays.coverage.texels.size(); ++i) {
            const float* a = planes[0] + 4 * i;
            if (a[3] == 0) continue;
            rays.coverage.texels[i] = static_cast<std::uint8_t>(Coverage::hit);
            rays.uv.texels[2 * i] = a[0];
            rays.uv.texels[2 * i + 1] = a[1];
            rays.lod.texels[i] = a[2];
            std::copy_n(planes[1] + 4 * i, 3, rays.view.texels.begin() + static_cast<std::ptrdiff_t>(3 * i));
        }
        return rays;
    });
}

Frame GpuRenderer::draw(const Stage& stage, const GpuMaterial& material, const Technique& technique, const MarchParams& params,
                        const PictureSettings& settings) {
    const Timed one[] = {{&technique, params, settings.options}};
    return std::move(draw_timed(stage, material, one, settings, 0).front());
}

std::vector<Frame> GpuRenderer::draw_timed(const Stage& stage, const GpuMaterial& material, std::span<const Timed> timed,
                                           const PictureSettings& settings, int runs, const Progress& progress) {
    return gpu::vulkan_errors_as("draw", "pictures on " + device_name(), [&] {
        State& s = *state_;
        const int width = settings.width;
        const int height = settings.height;
        assert(!settings.offsets.empty());
        const auto draw_of = [&](const FragmentHost& host, const Timed& t) {
            return HeightFieldPass::Draw{.host = host,
                                         .technique = t.technique,
                                         .params = t.params,
                                         .options = t.options,
                                         .material = material,
                                         .scene = s.scene,
                                         .background = stage.lighting.background};
        };

        const int samples = static_cast<int>(settings.offsets.size());
        const int rounds = std::max(runs + 1, samples);
        const double draws = static_cast<double>(timed.size()) * (1 + rounds);
        double drawn = 0;

        std::vector<Frame> frames;
        s.scene.update(stage, width, height, {0, 0});
        for (const Timed& t : timed) {
            frames.push_back(frame_of(s.draw(draw_of(record_host, t), width, height), width, height));
            frames.back().source = "gpu: " + device_name();
            report(progress, "drawing", ++drawn / draws);
        }

        // The timed runs are the picture's samples too, as far as there are that many: a sample shifts by less than a pixel and
        // costs the same. Round 0 is not timed; it makes pipelines and warms caches.
        const gpu::Stopwatch stopwatch(s.device);
        const float share = 1.0f / static_cast<float>(samples);
        for (int round = 0; round < rounds; ++round) {
            const bool is_sample = round < samples;
            s.scene.update(stage, width, height, settings.offsets[static_cast<std::size_t>(is_sample ? round : 0)]);
            for (std::size_t t = 0; t < timed.size(); ++t) {
                double ms = 0;
                const auto planes = s.draw(draw_of(shade_host, timed[t]), width, height, is_sample, &stopwatch, &ms);
                if (round > 0 && round <= runs) frames[t].gpu_ms.push_back(ms);
                report(progress, "drawing", ++drawn / draws);
                if (!is_sample) continue;
                std::vector<float>& colour = frames[t].colour.texels;
                const float* sample = planes[0];
                for (std::size_t i = 0; i < colour.size() / 3; ++i)
                    for (std::size_t c = 0; c < 3; ++c) colour[3 * i + c] += share * sample[4 * i + c];
            }
        }
        return frames;
    });
}

std::vector<GpuRenderer::Cast> GpuRenderer::cast(const GpuMaterial& material, const Technique& technique, const MarchParams& params,
                                                 std::span<const glsl::SurfaceRay> rays) {
    return gpu::vulkan_errors_as("cast", "rays on " + device_name(), [&] {
        State& s = *state_;
        std::vector<Cast> casts;
        casts.reserve(rays.size());
        // A dispatch is limited to 65535 groups everywhere; a million rays at a time also keeps the buffers small.
        constexpr std::size_t most = std::size_t{1} << 20;
        for (std::size_t begin = 0; begin < rays.size(); begin += most) {
            const auto part = rays.subspan(begin, std::min(most, rays.size() - begin));
            const auto in =
                gpu::make_buffer(s.device, part.size() * sizeof(glsl::CastRay), vk::BufferUsageFlagBits::eStorageBuffer);
            const auto out =
                gpu::make_buffer(s.device, part.size() * sizeof(glsl::CastHit), vk::BufferUsageFlagBits::eStorageBuffer);
            for (std::size_t i = 0; i < part.size(); ++i) {
                const glsl::SurfaceRay& r = part[i];
                in.as<glsl::CastRay>()[i] = {r.uv.x,   r.uv.y,         r.uv_per_height.x, r.uv_per_height.y, r.view.x, r.view.y,
                                             r.view.z, r.height_scale, r.zero_level,      r.z_start,         r.z_end,  r.lod};
            }
            const auto set = make_descriptor_set(s.device, s.pass.layout().cast, {{vk::DescriptorType::eStorageBuffer, 2}});
            const vk::DescriptorBufferInfo buffers[] = {{.buffer = *in.handle, .range = VK_WHOLE_SIZE},
                                                        {.buffer = *out.handle, .range = VK_WHOLE_SIZE}};
            s.device.handle().updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = set.handle,
                                                                          .dstBinding = 0,
                                                                          .descriptorCount = 2,
                                                                          .descriptorType = vk::DescriptorType::eStorageBuffer,
                                                                          .pBufferInfo = buffers},
                                                   {});
            const vk::Pipeline pipeline = s.pass.cast_pipeline(technique);
            s.device.run([&](const vk::raii::CommandBuffer& commands) {
                const auto& layout = *s.pass.layout().cast_pipeline;
                commands.bindPipeline(vk::PipelineBindPoint::eCompute, pipeline);
                commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, layout, 0, {material.maps(), set.handle}, {});
                commands.pushConstants<DrawUniforms>(layout, vk::ShaderStageFlagBits::eCompute, 0,
                                                     DrawUniforms{params, {material.height_scale(), material.zero_level(), 0}, {}});
                commands.dispatch(static_cast<std::uint32_t>((part.size() + 63) / 64), 1, 1);
                gpu::full_barrier(commands);
            });
            for (std::size_t i = 0; i < part.size(); ++i) {
                const glsl::CastHit& h = out.as<const glsl::CastHit>()[i];
                glsl::SurfaceHit hit;
                hit.uv = {h.u, h.v};
                hit.height = h.height;
                hit.found = h.found != 0;
                casts.push_back({hit, h.fetches});
            }
        }
        return casts;
    });
}

}  // namespace relievo
