#include "viewer/panel.h"

#include "techniques/catalogue.h"

#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

namespace relievo {

namespace {

constexpr float natural_width = 384;  // the longest title of a technique beside its year
constexpr float least_width = 150;    // a slider and the word beside it
constexpr int most_rows = 14;         // of the menu before it scrolls

void text_view(std::string_view text) { ImGui::TextUnformatted(text.data(), text.data() + text.size()); }

void wrapped(std::string_view text) {
    ImGui::PushTextWrapPos(0);
    text_view(text);
    ImGui::PopTextWrapPos();
}

void faint(std::string_view text) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    wrapped(text);
    ImGui::PopStyleColor();
}

void tooltip(std::string_view text) {
    if (!ImGui::IsItemHovered()) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(ImGui::GetFontSize() * 24);
    text_view(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void gap() { ImGui::Dummy({0, ImGui::GetFontSize() * 0.2f}); }

void section() {
    gap();
    ImGui::Separator();
    gap();
}

std::string sentence(std::string_view clause) {
    std::string text(clause);
    if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text + ".";
}

void technique_menu(Controls& controls) {
    const auto table = techniques();
    const float row = ImGui::GetTextLineHeightWithSpacing();
    const float year = ImGui::CalcTextSize("0000 ").x + ImGui::GetStyle().ItemSpacing.x;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    const int rows = std::min(most_rows, static_cast<int>(table.size()));
    ImGui::BeginChild("techniques", {0, row * static_cast<float>(rows)}, false);
    for (const Technique& t : table) {
        ImGui::PushID(&t);
        const bool chosen = &t == controls.technique;
        if (ImGui::Selectable("##choose", chosen)) controls.technique = &t;
        if (chosen && ImGui::IsWindowAppearing()) ImGui::SetScrollHereY();
        tooltip(sentence(t.summary));
        ImGui::SameLine(ImGui::GetStyle().FramePadding.x);
        ImGui::TextDisabled("%d", t.source.year);
        ImGui::SameLine(ImGui::GetStyle().FramePadding.x + year);
        text_view(t.title);
        ImGui::PopID();
    }
    ImGui::EndChild();
    ImGui::PopStyleVar();
    const auto step = [&](int by) {
        const auto at = controls.technique - table.data() + by;
        if (at >= 0 && at < static_cast<std::ptrdiff_t>(table.size())) controls.technique = &table[static_cast<std::size_t>(at)];
    };
    if (ImGui::GetIO().WantTextInput) return;
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_UpArrow))) step(-1);
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_DownArrow))) step(1);
}

void about(const Technique& t, ImFont* heading) {
    ImGui::PushFont(heading);
    wrapped(t.title);
    ImGui::PopFont();
    faint(std::string(t.source.author) + " " + std::to_string(t.source.year));
    tooltip(t.source.title);
    wrapped(sentence(t.summary));
    faint("Limits: " + std::string(t.limits) + ".");
}

void knob_slider(Controls& controls, const Knob& knob) {
    MarchParams params = controls.params();
    // A range of more than a hundred steps is walked by ratio: the interesting end is the small one.
    const bool by_ratio = knob.min > 0 && knob.max / knob.min > 100;
    const ImGuiSliderFlags flags = ImGuiSliderFlags_AlwaysClamp | (by_ratio ? ImGuiSliderFlags_Logarithmic : 0);
    ImGui::PushID(&knob);
    text_view(knob.title);
    tooltip(knob.help);
    ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.52f);
    ImGui::SetNextItemWidth(-1);
    if (knob.is_integer()) {
        int value = static_cast<int>(std::lround(knob.get(params)));
        if (ImGui::SliderInt("##knob", &value, static_cast<int>(knob.min), static_cast<int>(knob.max), "%d", flags))
            controls.turn(knob, static_cast<float>(value));
    } else {
        float value = knob.get(params);
        char format[32];
        std::snprintf(format, sizeof format, "%%.%df %.*s",
                      std::max(0, static_cast<int>(std::ceil(-std::log10(knob.step) - 0.01f))), static_cast<int>(knob.unit.size()),
                      knob.unit.data());
        if (ImGui::SliderFloat("##knob", &value, knob.min, knob.max, format, flags)) controls.turn(knob, value);
    }
    tooltip(std::string(knob.help) + ". Ctrl-click to type a number.");
    ImGui::PopID();
}

void knob_sliders(Controls& controls) {
    if (controls.technique->knobs.count == 0) {
        faint("This technique has nothing to turn.");
        return;
    }
    bool any_turned = false;
    for (const KnobDefault& d : controls.technique->knobs) {
        knob_slider(controls, *d.knob);
        any_turned = any_turned || controls.turned.contains(d.knob);
    }
    if (any_turned && ImGui::Button("As the catalogue has them"))
        for (const KnobDefault& d : controls.technique->knobs) controls.turned.erase(d.knob);
}

void number_slider(Controls& controls, const ModifierNumber& number) {
    ImGui::PushID(&number);
    text_view(number.title);
    tooltip(number.help);
    ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.52f);
    ImGui::SetNextItemWidth(-1);
    float value = number.get(controls.options);
    char format[32];
    std::snprintf(format, sizeof format, "%%.%df %.*s",
                  std::max(0, static_cast<int>(std::ceil(-std::log10(number.step) - 0.01f))), static_cast<int>(number.unit.size()),
                  number.unit.data());
    if (ImGui::SliderFloat("##number", &value, number.min, number.max, format, ImGuiSliderFlags_AlwaysClamp))
        number.set(controls.options, value);
    tooltip(std::string(number.help) + ". Ctrl-click to type a number.");
    ImGui::PopID();
}

// A menu for each modifier, and under it the numbers that count with what is chosen.
void modifier_menus(Controls& controls) {
    if (!ImGui::CollapsingHeader("Modifiers")) return;
    for (const Modifier& m : modifiers()) {
        ImGui::PushID(&m);
        text_view(m.title);
        tooltip(sentence(m.help));
        ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.52f);
        ImGui::SetNextItemWidth(-1);
        if (ImGui::BeginCombo("##choice", std::string(m.value(controls.options).id).c_str())) {
            for (std::size_t i = 0; i < m.values.size(); ++i) {
                const int index = static_cast<int>(i);
                if (ImGui::Selectable(std::string(m.values[i].id).c_str(), controls.options.*m.choice == index))
                    controls.options.*m.choice = index;
                tooltip(sentence(m.values[i].help));
            }
            ImGui::EndCombo();
        }
        tooltip(sentence(m.value(controls.options).help));
        ImGui::PopID();
        for (const ModifierNumber& n : modifier_numbers())
            if (n.of == &m && n.counts(controls.options)) number_slider(controls, n);
    }
}

void view_buttons(Controls& controls) {
    const auto table = views();
    const float space = ImGui::GetStyle().ItemSpacing.x;
    const float width =
        (ImGui::GetContentRegionAvail().x - space * static_cast<float>(table.size() - 1)) / static_cast<float>(table.size());
    for (std::size_t i = 0; i < table.size(); ++i) {
        if (i > 0) ImGui::SameLine();
        const bool here = controls.view.id == table[i].id;
        if (here) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_Header));
        if (ImGui::Button(table[i].id.c_str(), {width, 0})) controls.look_from(table[i]);
        if (here) ImGui::PopStyleColor();
        char text[64];
        std::snprintf(text, sizeof text, "%g\u00b0 above the surface", table[i].elevation_deg);
        tooltip(text);
    }
}

bool height_slider(Controls& controls) {
    // A fifth of a repeat is a wall as deep as it is wide; beyond, nothing looks like a surface any more.
    constexpr float highest = 0.3f;
    text_view("Relief");
    ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.52f);
    ImGui::SetNextItemWidth(-1);
    ImGui::SliderFloat("##height", &controls.height_scale, 0.001f, highest, "%.3f", ImGuiSliderFlags_AlwaysClamp);
    const bool let_go = ImGui::IsItemDeactivatedAfterEdit();
    tooltip("amplitude of the heights, as a share of one repeat of the texture; the normals follow when the slider is let go");
    return let_go;
}

void figures(const PanelFacts& facts) {
    if (!facts.technique_ms.empty()) {
        // The median: one late frame on a shared machine should not make the figure jump.
        std::vector<float> sorted(facts.technique_ms.begin(), facts.technique_ms.end());
        std::ranges::sort(sorted);
        ImGui::Text("GPU %.2f ms", sorted[sorted.size() / 2]);
        tooltip(
            "time stamps around the technique's draw: the median of the frames in the curve. On the software device the reference, "
            "while it is being drawn, takes cores from it.");
        ImGui::SameLine(0, ImGui::GetFontSize());
        ImGui::TextDisabled("CPU %.2f ms", facts.frame_ms);
        tooltip("time the program takes to prepare and record a frame, waiting excluded");
        ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0, 0});
        ImGui::PlotLines("##times", facts.technique_ms.data(), static_cast<int>(facts.technique_ms.size()), 0, nullptr, 0,
                         sorted.back() * 1.2f, {ImGui::GetContentRegionAvail().x, ImGui::GetFontSize() * 2});
        ImGui::PopStyleVar();
    }
    ImGui::Text("%.1f fetches a pixel", facts.mean_fetches);
    tooltip(
        "mean of the search over the pixels that meet the surface, counted on a sixteenth of them; shading and shadow excluded");
}

// At the foot of the panel, if there is room: what it says is also in the command's --help.
void help(const std::string& device) {
    const std::string text =
        device + "\nLeft drag orbits, right drag moves the light, the wheel zooms, arrow keys choose the technique, Esc closes.";
    const float wanted = ImGui::CalcTextSize(text.c_str(), nullptr, false, ImGui::GetContentRegionAvail().x).y;
    const float room = ImGui::GetContentRegionAvail().y;
    if (room < wanted) return;
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + room - wanted);
    faint(text);
}

}  // namespace

float panel_width(float window_width, float text_scale) {
    const float width = std::floor(std::min(natural_width * text_scale, window_width / 2));
    return width < least_width * text_scale ? 0 : width;
}

bool draw_panel(Controls& controls, const PanelFacts& facts, const PanelSettings& settings) {
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({settings.width, settings.height});
    ImGui::Begin("panel", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
    text_view(facts.material);
    if (!facts.notes.empty()) {
        std::string notes;
        for (const std::string& note : facts.notes) notes += (notes.empty() ? "" : "\n\n") + note;
        tooltip(notes);
    }
    gap();
    technique_menu(controls);
    gap();
    about(*controls.technique, settings.heading);
    section();
    knob_sliders(controls);
    section();
    view_buttons(controls);
    const bool let_go = height_slider(controls);
    ImGui::Checkbox("Split", &controls.split);
    tooltip("the exact reference right of a divider that can be dragged");
    if (controls.split && facts.reference_share < 1) {
        ImGui::ProgressBar(static_cast<float>(facts.reference_share), {-1, ImGui::GetFontSize() * 0.3f}, "");
        tooltip("the reference is being drawn");
    }
    modifier_menus(controls);
    section();
    figures(facts);
    help(facts.device);
    ImGui::End();
    return let_go;
}

}  // namespace relievo
