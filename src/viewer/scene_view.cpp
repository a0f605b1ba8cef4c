#include "viewer/scene_view.h"

#include <algorithm>
#include <cstring>

namespace relievo {

namespace {

using F = vk::Format;

// The device encodes linear light to sRGB when it writes this format; the bytes are then those of the canvas.
F encoding_format(F canvas) { return canvas == F::eB8G8R8A8Unorm ? F::eB8G8R8A8Srgb : F::eR8G8B8A8Srgb; }

// Fetches are counted on one pixel in so many in each direction.
constexpr std::uint32_t probe_step = 4;

vk::Offset3D corner(vk::Rect2D area, std::uint32_t right = 0) {
    return {area.offset.x + static_cast<std::int32_t>(right), area.offset.y, 0};
}

constexpr vk::ImageSubresourceLayers whole{vk::ImageAspectFlagBits::eColor, 0, 0, 1};

}  // namespace

SceneView::SceneView(const gpu::Device& device, vk::Format format)
    : device_(device),
      pass_(device),
      scene_(device, pass_.layout()),
      stopwatch_(device),
      shade_host_{"shade.frag", {encoding_format(format)}},
      record_host_{"record.frag", {F::eR32G32B32A32Sfloat, F::eR32G32B32A32Sfloat, F::eR32Sfloat}},
      format_(format) {}

void SceneView::set_material(const BakedMaps& baked) {
    material_.emplace(device_, pass_.layout(), baked.maps, baked.height_scale, baked.zero_level);
}

void SceneView::set_height_scale(float height_scale) { material_->set_height_scale(height_scale); }

void SceneView::set_size(vk::Extent2D canvas, vk::Rect2D picture) {
    using Usage = vk::ImageUsageFlagBits;
    area_ = picture;
    canvas_ = gpu::make_image(device_, format_, canvas, 1, Usage::eColorAttachment | Usage::eTransferSrc | Usage::eTransferDst);
    technique_ = gpu::make_image(device_, shade_host_.targets[0], picture.extent, 1, Usage::eColorAttachment | Usage::eTransferSrc);
    reference_ = gpu::make_buffer(device_, vk::DeviceSize{4} * picture.extent.width * picture.extent.height,
                                  vk::BufferUsageFlagBits::eTransferSrc);
    has_reference_ = false;
    probe_ = make_targets(device_, record_host_, static_cast<int>((picture.extent.width + probe_step - 1) / probe_step),
                          static_cast<int>((picture.extent.height + probe_step - 1) / probe_step));
    probe_.read.push_back(gpu::make_buffer(device_, vk::DeviceSize{16} * probe_.extent.width * probe_.extent.height,
                                           vk::BufferUsageFlagBits::eTransferDst));
    probe_.read.push_back(gpu::make_buffer(device_, vk::DeviceSize{4} * probe_.extent.width * probe_.extent.height,
                                           vk::BufferUsageFlagBits::eTransferDst));
}

void SceneView::set_reference(const Image8& reference) {
    if (reference.texels.size() != reference_.size) return;  // of the size before
    const bool blue_first = format_ == F::eB8G8R8A8Unorm;
    auto* out = reference_.as<std::uint8_t>();
    for (std::size_t i = 0; i < reference.texels.size(); i += 4) {
        std::memcpy(out + i, reference.texels.data() + i, 4);
        if (blue_first) std::swap(out[i], out[i + 2]);
    }
    has_reference_ = true;
}

HeightFieldPass::Draw SceneView::draw(const Controls& controls, const FragmentHost& host) const {
    return {.host = host,
            .technique = controls.technique,
            .params = controls.params(),
            .options = controls.options,
            .material = *material_,
            .scene = scene_,
            .background = &host == &shade_host_ ? background_ : Vec3f{}};
}

double SceneView::mean_fetches(const Controls& controls) {
    scene_.update(controls.stage(), static_cast<int>(probe_.extent.width), static_cast<int>(probe_.extent.height), {0, 0});
    Controls without_shadow = controls;
    without_shadow.options.shadow = glsl::shadow_none;  // its search is not counted, so it need not be made
    const auto what = draw(without_shadow, record_host_);
    pass_.pipeline(what);
    device_.run([&](const vk::raii::CommandBuffer& commands) {
        std::vector<vk::ImageView> views;
        for (const gpu::Image& image : probe_.images) {
            gpu::transition(commands, image, vk::ImageLayout::eUndefined, vk::ImageLayout::eColorAttachmentOptimal);
            views.push_back(*image.view);
        }
        pass_.record(commands, what, views, probe_.extent);
        for (const std::size_t plane : {0, 2}) {
            gpu::transition(commands, probe_.images[plane], vk::ImageLayout::eColorAttachmentOptimal,
                            vk::ImageLayout::eTransferSrcOptimal);
            gpu::read_back(commands, probe_.images[plane], probe_.read[plane / 2]);
        }
    });
    const auto* coverage = probe_.read[0].as<const float>();
    const auto* fetches = probe_.read[1].as<const float>();
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < std::size_t{probe_.extent.width} * probe_.extent.height; ++i) {
        if (coverage[4 * i + 3] == 0) continue;
        sum += fetches[i];
        ++count;
    }
    return count > 0 ? sum / count : 0;
}

void SceneView::prepare(const Controls& controls) {
    const Stage stage = controls.stage();
    background_ = stage.lighting.background;
    scene_.update(stage, static_cast<int>(area_.extent.width), static_cast<int>(area_.extent.height), {0, 0});
    pass_.pipeline(draw(controls, shade_host_));
}

void SceneView::record(const vk::raii::CommandBuffer& commands, const Controls& controls, std::optional<std::uint32_t> divider_px) {
    using Layout = vk::ImageLayout;
    gpu::transition(commands, technique_, Layout::eUndefined, Layout::eColorAttachmentOptimal);
    stopwatch_.start(commands);
    const vk::ImageView view = *technique_.view;
    pass_.record(commands, draw(controls, shade_host_), {&view, 1}, area_.extent);
    stopwatch_.stop(commands);
    gpu::transition(commands, technique_, Layout::eColorAttachmentOptimal, Layout::eTransferSrcOptimal);

    gpu::transition(commands, canvas_, Layout::eUndefined, Layout::eTransferDstOptimal);
    const std::uint32_t width = area_.extent.width;
    const std::uint32_t from = has_reference_ && divider_px ? std::min(*divider_px, width) : width;
    if (from > 0)
        commands.copyImage(*technique_.handle, Layout::eTransferSrcOptimal, *canvas_.handle, Layout::eTransferDstOptimal,
                           vk::ImageCopy{.srcSubresource = whole,
                                         .dstSubresource = whole,
                                         .dstOffset = corner(area_),
                                         .extent = {from, area_.extent.height, 1}});
    if (from < width)
        commands.copyBufferToImage(*reference_.handle, *canvas_.handle, Layout::eTransferDstOptimal,
                                   vk::BufferImageCopy{.bufferOffset = vk::DeviceSize{4} * from,
                                                       .bufferRowLength = width,
                                                       .imageSubresource = whole,
                                                       .imageOffset = corner(area_, from),
                                                       .imageExtent = {width - from, area_.extent.height, 1}});
    gpu::transition(commands, canvas_, Layout::eTransferDstOptimal, Layout::eColorAttachmentOptimal);
}

Image8 SceneView::read_canvas() const {
    const auto [width, height] = canvas_.extent;
    const auto buffer = gpu::make_buffer(device_, vk::DeviceSize{4} * width * height, vk::BufferUsageFlagBits::eTransferDst);
    device_.run([&](const vk::raii::CommandBuffer& commands) { gpu::read_back(commands, canvas_, buffer); });
    Image8 picture(static_cast<int>(width), static_cast<int>(height), 4);
    std::memcpy(picture.texels.data(), buffer.mapped, picture.texels.size());
    for (std::size_t i = 0; i < picture.texels.size(); i += 4) {
        if (format_ == F::eB8G8R8A8Unorm) std::swap(picture.texels[i], picture.texels[i + 2]);
        picture.texels[i + 3] = 255;  // a window has no transparency
    }
    return picture;
}

}  // namespace relievo
