#include "viewer/viewer.h"

#include "core/error.h"
#include "gpu/swapchain.h"
#include "pipeline/map_set_bake.h"
#include "pipeline/shown_picture.h"
#include "viewer/panel.h"
#include "viewer/picture_input.h"
#include "viewer/reference_worker.h"
#include "viewer/scene_view.h"
#include "viewer/ui_layer.h"
#include "viewer/window.h"

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

namespace relievo {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t remembered_frames = 90;
// How long frames follow each other after the last event; then the window rests until something happens.
constexpr double lively_s = 0.4;
constexpr double resting_s = 0.25;   // between two looks at the signals
constexpr double watching_s = 0.03;  // between two looks at a reference that is being drawn

std::unique_ptr<gpu::Device> presenting_device(const Window& window, const std::string& choice, bool validation) {
    const gpu::DeviceSettings settings{.choice = choice,
                                       .validation = validation,
                                       .instance_extensions = Window::instance_extensions(),
                                       .device_extensions = {gpu::swapchain_extension}};
    const auto make = [&](gpu::DeviceSettings with) {
        auto device = std::make_unique<gpu::Device>(with);
        const auto surface = window.make_surface(*device);
        if (!device->physical().getSurfaceSupportKHR(device->queue_family(), *surface))
            throw Error("open", "a window on " + device->info().name, "this device does not show pictures on this display",
                        "choose another with --device (relievo list devices); the software device shows on any display");
        return device;
    };
    try {
        return make(settings);
    } catch (const Error&) {
        // A computing card without a display beside the software device, which has one: unless a device was named, that will do.
        if (!choice.empty()) throw;
        auto software = settings;
        software.choice = "software";
        std::unique_ptr<gpu::Device> device;
        try {
            device = make(software);
        } catch (const Error&) {
        }
        if (!device) throw;
        return device;
    }
}

// Slopes grow with the amplitude: exact for normals of a height field, level by level the same for their mip chain.
void scale_slopes(std::vector<ImageF>& chain, float factor) {
    for (ImageF& level : chain)
        for (std::size_t i = 0; i + 2 < level.texels.size(); i += 3) {
            float* n = level.texels.data() + i;
            const Vec3f scaled = normalize(Vec3f{n[0] * factor, n[1] * factor, n[2]});
            n[0] = scaled.x;
            n[1] = scaled.y;
            n[2] = scaled.z;
        }
}

std::string material_label(const Material& material) {
    std::string label = material.name;
    const int width = material.height.empty() ? (material.normal ? material.normal->width : 0) : material.height.width();
    const int height = material.height.empty() ? (material.normal ? material.normal->height : 0) : material.height.height();
    return label + "  " + std::to_string(width) + " \u00d7 " + std::to_string(height);
}

class Viewer {
public:
    Viewer(const ViewerSettings& settings, BakedMaps baked, std::string label, std::unique_ptr<Window> window)
        : settings_(settings),
          label_(std::move(label)),
          baked_(std::move(baked)),
          window_(std::move(window)),
          device_(presenting_device(*window_, settings.device, settings.validation)),
          surface_(window_->make_surface(*device_)),
          swapchain_(*device_, *surface_, window_->size_px()),
          scene_(*device_, swapchain_.format()),
          ui_(*window_, *device_, swapchain_.format()),
          controls_(opening_controls(*settings.technique, settings.view, baked_.height_scale)),
          worker_(baked_.maps, settings.material.threads) {
        controls_.split = settings.split;
        scene_.set_material(baked_);
        resize();
    }

    void run() {
        int frames = 0;
        auto last_event = Clock::now();
        while (!window_->closing()) {
            if (settings_.poll) settings_.poll();
            const bool lively = settings_.frames > 0 || seconds_since(last_event) < lively_s;
            const bool watching = controls_.split && worker_.state().share < 1;
            window_->handle_events(lively ? 0 : watching ? watching_s : resting_s);
            if (swapchain_.extent().width == 0 || swapchain_.extent() != window_->size_px()) {
                resize();
                if (swapchain_.extent().width == 0) {
                    window_->handle_events(resting_s);
                    continue;
                }
            }
            const bool last = settings_.frames > 0 && frames + 1 >= settings_.frames;
            const bool shown = draw_frame(last);
            if (shown) ++frames;
            if (touched()) last_event = Clock::now();
            if (last && shown) break;
            if (!ImGui::GetIO().WantTextInput && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) break;
        }
        swapchain_.wait();
        if (!settings_.screenshot.empty() && drawn_) write_shown_picture(settings_.screenshot, scene_.read_canvas());
        if (const auto messages = device_->validation_messages(); !messages.empty())
            throw Error("show", "the window without a validation message",
                        std::to_string(messages.size()) + ", the first: " + messages.front());
    }

private:
    static double seconds_since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

    // Whether a person did something in this frame.
    bool touched() {
        const ImGuiIO& io = ImGui::GetIO();
        const bool mouse = io.MouseDelta.x != 0 || io.MouseDelta.y != 0 || io.MouseWheel != 0 || ImGui::IsAnyMouseDown();
        return mouse || ImGui::IsAnyItemActive() || std::exchange(changed_, false);
    }

    void resize() {
        swapchain_.rebuild(window_->size_px());
        const auto extent = swapchain_.extent();
        if (extent.width == 0) return;
        const float points = window_->pixels_per_point();
        panel_points_ = panel_width(static_cast<float>(extent.width) / points, window_->text_scale());
        const auto left = static_cast<std::uint32_t>(std::lround(panel_points_ * points));
        scene_.set_size(extent, {{static_cast<std::int32_t>(left), 0}, {std::max(1u, extent.width - left), extent.height}});
        ui_.set_target(scene_.canvas());
        reference_seen_ = 0;
        reference_of_.clear();
        fetches_of_.clear();
        changed_ = true;
    }

    // Asks for the reference of what is looked at, and takes over what there is of it.
    void update_reference(bool whole) {
        if (!controls_.split) return;
        const auto extent = scene_.picture().extent;
        std::vector<double> now = controls_.scene_numbers();
        now.insert(now.end(), {static_cast<double>(extent.width), static_cast<double>(extent.height)});
        if (now != reference_of_) {
            reference_of_ = now;
            worker_.ask({.stage = controls_.stage(),
                         .width = static_cast<int>(extent.width),
                         .height = static_cast<int>(extent.height),
                         .height_scale = controls_.height_scale,
                         .zero_level = baked_.zero_level,
                         .options = controls_.options});
        }
        if (whole) worker_.wait();
        const auto state = worker_.state();
        facts_.reference_share = state.share;
        if (state.version == reference_seen_) return;
        reference_seen_ = state.version;
        scene_.set_reference(worker_.picture());
    }

    void update_fetches() {
        std::vector<double> now = controls_.scene_numbers();
        now.insert(now.end(), {static_cast<double>(scene_.picture().extent.width), static_cast<double>(scene_.picture().extent.height)});
        const MarchParams params = controls_.params();
        for (const Knob* knob : knobs) now.push_back(knob->get(params));
        if (now == fetches_of_ && fetches_technique_ == controls_.technique) return;
        fetches_of_ = now;
        fetches_technique_ = controls_.technique;
        facts_.mean_fetches = scene_.mean_fetches(controls_);
    }

    void settle_height_scale() {
        worker_.forget();  // it reads the normals
        scale_slopes(baked_.maps.normal, controls_.height_scale / baked_.height_scale);
        // A sphere of the old metric holds one of the new, smaller by the ratio where the relief grew.
        for (float& d : baked_.maps.distance.texels) d *= std::min(1.0f, baked_.height_scale / controls_.height_scale);
        baked_.height_scale = controls_.height_scale;
        scene_.set_material(baked_);
        reference_of_.clear();
    }

    // False if the window had changed, so that the frame was not shown.
    bool draw_frame(bool last) {
        const auto extent = swapchain_.extent();
        const float points = window_->pixels_per_point();
        swapchain_.wait();
        const auto began = Clock::now();
        if (drawn_) {
            if (technique_ms_.size() == remembered_frames) technique_ms_.erase(technique_ms_.begin());
            technique_ms_.push_back(static_cast<float>(scene_.technique_ms()));
        }

        ui_.begin_frame();
        const float width = static_cast<float>(extent.width) / points;
        const float height = static_cast<float>(extent.height) / points;
        const PictureArea area{panel_points_, 0, width - panel_points_, height};
        facts_.material = label_;
        facts_.notes = baked_.notes;
        facts_.device = device_->info().name;
        facts_.technique_ms = technique_ms_;
        const Technique* before = controls_.technique;
        const bool settled = panel_points_ > 0 && draw_panel(controls_, facts_, {panel_points_, height, ui_.heading()});
        if (controls_.technique != before) technique_ms_.clear();
        input_.handle(controls_, area);
        scene_.set_height_scale(controls_.height_scale);
        if (settled) settle_height_scale();
        update_reference(last && !settings_.screenshot.empty());
        update_fetches();
        const bool split = controls_.split && scene_.has_reference();
        if (split) input_.draw_split(controls_, area, facts_.reference_share < 1 ? "exact reference, refining" : "exact reference");
        ui_.end_frame();

        scene_.prepare(controls_);
        const auto picture = scene_.picture();
        std::optional<std::uint32_t> divider;
        if (split) divider = static_cast<std::uint32_t>(std::lround(static_cast<float>(picture.extent.width) * controls_.divider));
        const bool shown = swapchain_.show([&](const vk::raii::CommandBuffer& commands, vk::Image image) {
            scene_.record(commands, controls_, divider);
            ui_.record(commands);
            gpu::transition(commands, scene_.canvas(), vk::ImageLayout::eColorAttachmentOptimal,
                            vk::ImageLayout::eTransferSrcOptimal);
            constexpr vk::ImageSubresourceLayers whole{vk::ImageAspectFlagBits::eColor, 0, 0, 1};
            commands.copyImage(
                *scene_.canvas().handle, vk::ImageLayout::eTransferSrcOptimal, image, vk::ImageLayout::eTransferDstOptimal,
                vk::ImageCopy{.srcSubresource = whole, .dstSubresource = whole, .extent = {extent.width, extent.height, 1}});
            facts_.frame_ms = 1e3 * seconds_since(began);
        });
        if (shown) {
            drawn_ = true;
        } else {
            resize();
            drawn_ = false;
        }
        return shown;
    }

    const ViewerSettings& settings_;
    std::string label_;
    BakedMaps baked_;
    std::unique_ptr<Window> window_;
    std::unique_ptr<gpu::Device> device_;
    vk::raii::SurfaceKHR surface_;
    gpu::Swapchain swapchain_;
    SceneView scene_;
    UiLayer ui_;
    Controls controls_;
    PictureInput input_;
    PanelFacts facts_;
    std::vector<float> technique_ms_;
    float panel_points_ = 0;
    std::uint64_t reference_seen_ = 0;
    std::vector<double> reference_of_;  // what the last request was for
    std::vector<double> fetches_of_;
    const Technique* fetches_technique_ = nullptr;
    bool drawn_ = false;  // a frame at the present size
    bool changed_ = false;
    ReferenceWorker worker_;
};

}  // namespace

void run_viewer(const ViewerSettings& settings) {
    assert(settings.technique != nullptr && settings.width > 0 && settings.height > 0);
    // What would spoil the end is known before the work: no display, a screenshot that cannot be written.
    if (!settings.screenshot.empty()) {
        if (std::filesystem::path(settings.screenshot).extension() != ".png")
            throw UsageError("--screenshot " + settings.screenshot + ": the picture is written as .png");
        require_writable(settings.screenshot);
    }
    auto window = std::make_unique<Window>("relievo", settings.width, settings.height);
    report(settings.progress, "loading", 0);
    Material material = load_source(settings.material);
    std::string label = material_label(material);
    BakeMachine machine = BakeMachine::automatic(settings.device);
    BakedMaps baked = bake_maps(std::move(material), every_map /* the menu reaches every technique */,
                                {.threads = settings.material.threads, .progress = settings.progress, .machine = &machine});
    gpu::vulkan_errors_as("show", "the window",
                          [&] { Viewer(settings, std::move(baked), std::move(label), std::move(window)).run(); });
}

}  // namespace relievo
