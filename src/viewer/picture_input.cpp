#include "viewer/picture_input.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace relievo {

namespace {

constexpr double degrees_per_point = 0.3;
constexpr float divider_reach = 8;  // points on either side that take hold of it

float divider_x(const Controls& controls, const PictureArea& area) { return std::round(area.x + area.width * controls.divider); }

void label(const std::string& text, ImVec2 corner, bool to_the_left) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 padding{8, 4};
    if (to_the_left) corner.x -= size.x + 2 * padding.x;
    auto* list = ImGui::GetBackgroundDrawList();
    list->AddRectFilled(corner, {corner.x + size.x + 2 * padding.x, corner.y + size.y + 2 * padding.y}, IM_COL32(18, 18, 19, 190),
                        4);
    list->AddText({corner.x + padding.x, corner.y + padding.y}, IM_COL32(235, 235, 238, 255), text.c_str());
}

}  // namespace

void PictureInput::handle(Controls& controls, const PictureArea& area) {
    const ImGuiIO& io = ImGui::GetIO();
    const bool over = !io.WantCaptureMouse && io.MousePos.x >= area.x && io.MousePos.y >= area.y &&
                      io.MousePos.x < area.x + area.width && io.MousePos.y < area.y + area.height;
    near_divider_ = over && controls.split && std::abs(io.MousePos.x - divider_x(controls, area)) <= divider_reach;
    if (over && io.MouseClicked[ImGuiMouseButton_Left]) drag_ = near_divider_ ? Drag::divider : Drag::orbit;
    if (over && io.MouseClicked[ImGuiMouseButton_Right]) drag_ = Drag::light;
    if (!io.MouseDown[drag_ == Drag::light ? ImGuiMouseButton_Right : ImGuiMouseButton_Left]) drag_ = Drag::none;
    if (near_divider_ || drag_ == Drag::divider) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);

    const double right = io.MouseDelta.x * degrees_per_point;
    const double down = io.MouseDelta.y * degrees_per_point;
    const bool moved = right != 0 || down != 0;
    if (drag_ == Drag::divider) controls.divider = std::clamp((io.MousePos.x - area.x) / area.width, 0.0f, 1.0f);
    // The surface follows the hand, and so does the light across the sky.
    if (drag_ == Drag::orbit && moved) controls.orbit(-right, down);
    if (drag_ == Drag::light && moved) controls.move_light(right, -down);
    if (over && io.MouseWheel != 0) controls.zoom_by(io.MouseWheel);
}

void PictureInput::draw_split(const Controls& controls, const PictureArea& area, const std::string& reference_label) const {
    const float x = divider_x(controls, area);
    const bool held = near_divider_ || drag_ == Drag::divider;
    auto* list = ImGui::GetBackgroundDrawList();
    list->PushClipRect({area.x, area.y}, {area.x + area.width, area.y + area.height});
    list->AddLine({x, area.y}, {x, area.y + area.height}, IM_COL32(18, 18, 19, 130), 4);
    list->AddLine({x, area.y}, {x, area.y + area.height}, IM_COL32(245, 245, 247, held ? 255 : 205), held ? 2.5f : 1.5f);
    const ImVec2 grip{x, area.y + area.height / 2};
    list->AddCircleFilled(grip, 13, IM_COL32(18, 18, 19, 200));
    list->AddCircle(grip, 13, IM_COL32(245, 245, 247, held ? 255 : 205), 0, 1.5f);
    for (const float side : {-1.0f, 1.0f})
        list->AddTriangleFilled({grip.x + side * 8, grip.y}, {grip.x + side * 3, grip.y - 4}, {grip.x + side * 3, grip.y + 4},
                                IM_COL32(245, 245, 247, 230));
    const float y = area.y + area.height - ImGui::GetFontSize() - 24;
    label(std::string(controls.technique->title), {x - 12, y}, true);
    label(reference_label, {x + 12, y}, false);
    list->PopClipRect();
}

}  // namespace relievo
