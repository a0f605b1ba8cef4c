#include "viewer/ui_layer.h"

#include <GLFW/glfw3.h>

#include <imgui.h>
#include <imgui/backends/imgui_impl_glfw.h>
#include <imgui/backends/imgui_impl_vulkan.h>

#include <array>
#include <filesystem>

namespace relievo {

namespace {

constexpr float text_px = 15;
constexpr float heading_px = 20;

// Where systems keep a plain sans-serif face. Without any, ImGui's own bitmap face is used: readable, not pretty.
constexpr std::array faces{
    "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
    "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
    "/usr/share/fonts/TTF/DejaVuSans.ttf",
    "/usr/share/fonts/truetype/noto/NotoSans-Regular.ttf",
    "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
};

ImFont* add_face(float size_px) {
    for (const char* face : faces) {
        std::error_code ignored;
        if (!std::filesystem::is_regular_file(face, ignored)) continue;
        if (ImFont* font = ImGui::GetIO().Fonts->AddFontFromFileTTF(face, size_px)) return font;
    }
    ImFontConfig config;
    config.SizePixels = size_px;
    return ImGui::GetIO().Fonts->AddFontDefault(&config);
}

// Dark and without hue, so that the picture's colours are judged beside grey; one accent for what can be turned.
void set_style(float scale) {
    ImGui::StyleColorsDark();
    ImGuiStyle& style = ImGui::GetStyle();
    style.WindowRounding = 0;
    style.FrameRounding = 4;
    style.GrabRounding = 4;
    style.PopupRounding = 4;
    style.ScrollbarRounding = 4;
    style.WindowBorderSize = 0;
    style.WindowPadding = {16, 14};
    style.FramePadding = {8, 3};
    style.ItemSpacing = {8, 5};
    style.ScrollbarSize = 10;
    style.GrabMinSize = 12;
    const ImVec4 accent{0.93f, 0.69f, 0.36f, 1};
    const auto grey = [](float v, float alpha = 1) { return ImVec4{v, v, v * 1.03f, alpha}; };
    const auto warm = [&](float alpha) { return ImVec4{accent.x, accent.y, accent.z, alpha}; };
    auto* c = style.Colors;
    c[ImGuiCol_WindowBg] = grey(0.090f);
    c[ImGuiCol_ChildBg] = grey(0.090f);
    c[ImGuiCol_PopupBg] = grey(0.13f, 0.98f);
    c[ImGuiCol_Text] = grey(0.88f);
    c[ImGuiCol_TextDisabled] = grey(0.56f);
    c[ImGuiCol_FrameBg] = grey(0.16f);
    c[ImGuiCol_FrameBgHovered] = grey(0.21f);
    c[ImGuiCol_FrameBgActive] = grey(0.25f);
    c[ImGuiCol_Button] = grey(0.19f);
    c[ImGuiCol_ButtonHovered] = grey(0.26f);
    c[ImGuiCol_ButtonActive] = grey(0.32f);
    c[ImGuiCol_Header] = warm(0.22f);
    c[ImGuiCol_HeaderHovered] = warm(0.14f);
    c[ImGuiCol_HeaderActive] = warm(0.30f);
    c[ImGuiCol_SliderGrab] = warm(0.85f);
    c[ImGuiCol_SliderGrabActive] = accent;
    c[ImGuiCol_CheckMark] = accent;
    c[ImGuiCol_Separator] = grey(0.22f);
    c[ImGuiCol_PlotLines] = warm(0.9f);
    c[ImGuiCol_PlotHistogram] = warm(0.9f);
    c[ImGuiCol_ScrollbarBg] = grey(0.090f);
    c[ImGuiCol_ScrollbarGrab] = grey(0.25f);
    style.ScaleAllSizes(scale);
}

void require_success(VkResult result) {
    if (result < 0) throw Error("draw", "the controls", vk::to_string(static_cast<vk::Result>(result)));
}

vk::raii::RenderPass make_pass(const gpu::Device& device, vk::Format format) {
    const vk::AttachmentDescription over{.format = format,
                                         .samples = vk::SampleCountFlagBits::e1,
                                         .loadOp = vk::AttachmentLoadOp::eLoad,
                                         .storeOp = vk::AttachmentStoreOp::eStore,
                                         .stencilLoadOp = vk::AttachmentLoadOp::eDontCare,
                                         .stencilStoreOp = vk::AttachmentStoreOp::eDontCare,
                                         .initialLayout = vk::ImageLayout::eColorAttachmentOptimal,
                                         .finalLayout = vk::ImageLayout::eColorAttachmentOptimal};
    const vk::AttachmentReference colour{.attachment = 0, .layout = vk::ImageLayout::eColorAttachmentOptimal};
    const vk::SubpassDescription subpass{
        .pipelineBindPoint = vk::PipelineBindPoint::eGraphics, .colorAttachmentCount = 1, .pColorAttachments = &colour};
    return {device.handle(),
            vk::RenderPassCreateInfo{.attachmentCount = 1, .pAttachments = &over, .subpassCount = 1, .pSubpasses = &subpass}};
}

}  // namespace

UiLayer::UiLayer(const Window& window, const gpu::Device& device, vk::Format format) : window_(window.handle()), device_(device) {
    pass_ = make_pass(device, format);
    const vk::DescriptorPoolSize one_face{vk::DescriptorType::eCombinedImageSampler, 1};
    // The backend frees its set by itself.
    descriptors_ = vk::raii::DescriptorPool(
        device.handle(), vk::DescriptorPoolCreateInfo{.flags = vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet,
                                                      .maxSets = 1,
                                                      .poolSizeCount = 1,
                                                      .pPoolSizes = &one_face});
    IMGUI_CHECKVERSION();
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // the window leaves no files behind
    ImGui::GetIO().ConfigWindowsMoveFromTitleBarOnly = true;
    const float scale = window.text_scale();
    set_style(scale);
    add_face(text_px * scale);
    heading_ = add_face(heading_px * scale);
    ImGui_ImplGlfw_InitForVulkan(window.handle(), true);
    ImGui_ImplVulkan_InitInfo info{};
    info.Instance = *device.instance();
    info.PhysicalDevice = *device.physical();
    info.Device = *device.handle();
    info.QueueFamily = device.queue_family();
    info.Queue = *device.queue();
    info.DescriptorPool = *descriptors_;
    // Buffers the backend cycles through; at least two are asked for, although one frame is in flight.
    info.MinImageCount = 2;
    info.ImageCount = 2;
    info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
    info.CheckVkResultFn = require_success;
    ImGui_ImplVulkan_Init(&info, *pass_);
    device.run([](const vk::raii::CommandBuffer& commands) { ImGui_ImplVulkan_CreateFontsTexture(*commands); });
    ImGui_ImplVulkan_DestroyFontUploadObjects();
}

UiLayer::~UiLayer() {
    ImGui_ImplVulkan_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
}

void UiLayer::set_target(const gpu::Image& image) {
    extent_ = image.extent;
    framebuffer_ = vk::raii::Framebuffer(device_.handle(), vk::FramebufferCreateInfo{.renderPass = *pass_,
                                                                                     .attachmentCount = 1,
                                                                                     .pAttachments = &*image.view,
                                                                                     .width = extent_.width,
                                                                                     .height = extent_.height,
                                                                                     .layers = 1});
}

// The backend of imgui 1.86 keeps only whether a key is down now: one pressed and released within a slow frame would never be seen.
// GLFW's sticky keys (Window asks for them) stay down until they are asked about once.
void UiLayer::hold_short_presses() const {
    ImGuiIO& io = ImGui::GetIO();
    for (const int key : io.KeyMap)
        if (key >= 0) io.KeysDown[key] = glfwGetKey(window_, key) == GLFW_PRESS;  // the backend's indices are GLFW's keys
}

void UiLayer::begin_frame() const {
    ImGui_ImplVulkan_NewFrame();
    ImGui_ImplGlfw_NewFrame();
    hold_short_presses();
    ImGui::NewFrame();
}

void UiLayer::end_frame() const { ImGui::Render(); }

void UiLayer::record(const vk::raii::CommandBuffer& commands) const {
    commands.beginRenderPass({.renderPass = *pass_, .framebuffer = *framebuffer_, .renderArea = {{0, 0}, extent_}},
                             vk::SubpassContents::eInline);
    ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), *commands);
    commands.endRenderPass();
}

}  // namespace relievo
