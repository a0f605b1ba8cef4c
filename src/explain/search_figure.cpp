#include "explain/search_figure.h"

#include "explain/panel.h"
#include "figure/font.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>

namespace relievo {

namespace {

// Pixels. The overview and the close-up stand side by side.
constexpr double figure_width = 1000;
constexpr double margin = 22;
constexpr double axis_room = 34;      // for the numbers left of a panel
constexpr double overview_width = 590;
constexpr double closeup_width = figure_width - 2 * margin - 2 * axis_room - overview_width - 12;
constexpr double lowest_panel = 150, highest_panel = 260;
constexpr double below_floor = 0.05, above_top = 0.10;  // of the slab, shown outside of it

std::string text(const char* format, double value) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, format, value);
    return buffer;
}

// A step of 1, 2 or 5 times a power of ten that cuts the range into at most `most` pieces.
double tick_step(double range, int most) {
    const double decade = std::pow(10, std::floor(std::log10(range / most)));
    for (const double m : {1.0, 2.0, 5.0})
        if (range / (m * decade) <= most) return m * decade;
    return 10 * decade;
}

std::string tick_text(double value, double step) {
    const int digits = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.*f", digits, std::abs(value) < step / 1e6 ? 0.0 : value);
    return buffer;
}

void draw_axes(Drawing& drawing, const Panel& panel, bool named) {
    const Rect& box = panel.box;
    drawing.marks.push_back(Path{.points = {{box.left, box.top}, {box.right, box.top}, {box.right, box.bottom}, {box.left, box.bottom}}, .closed = true, .ink = Ink::paper, .fill = 1});
    const double x_step = tick_step(panel.x_right - panel.x_left, named ? 10 : 5);
    for (double x = std::ceil(panel.x_left / x_step) * x_step; x <= panel.x_right; x += x_step) {
        const Vec2d p = panel.at(x, panel.z_bottom);
        drawing.marks.push_back(Path{.points = {{p.x, box.top}, {p.x, box.bottom + 4}}, .ink = Ink::grid, .width = 1});
        drawing.marks.push_back(Label{.at = {p.x, box.bottom + 16}, .text = tick_text(x, x_step), .ink = Ink::muted, .size = 10.5, .anchor = Anchor::middle});
    }
    const double z_step = named ? 0.2 : tick_step(panel.z_top - panel.z_bottom, 4);
    for (double z = std::ceil(panel.z_bottom / z_step) * z_step; z <= panel.z_top; z += z_step) {
        const Vec2d p = panel.at(panel.x_left, z);
        drawing.marks.push_back(Path{.points = {{box.left - 4, p.y}, {box.right, p.y}}, .ink = Ink::grid, .width = 1});
        drawing.marks.push_back(Label{.at = {box.left - 7, p.y + 3.8}, .text = tick_text(z, z_step), .ink = Ink::muted, .size = 10.5, .anchor = Anchor::end});
    }
}

// The stretch of the section on which everything of interest happens: of all searches together, so that their axes agree.
struct Window {
    double left = 0, right = 0;
};

Window window_of(const Section& section, std::span<const Search> searches, double texels_per_height) {
    double left = 0, right = section.truth.x;
    const auto include = [&](double x) { left = std::min(left, x), right = std::max(right, x); };
    // What lies far from the true hit (parallax at grazing views) is pointed to instead of squeezing all else.
    const double reach = std::max(section.truth.x, 8.0);
    const auto near = [&](double x) { return x > -0.75 * reach && x < 2.5 * reach; };
    for (const Search& s : searches) {
        if (s.has_found && near(s.found.x)) include(s.found.x);
        for (const Step& step : s.steps)
            if (step.kind != StepKind::node && step.kind != StepKind::cell && near(step.x)) include(step.x);
    }
    const double pad = 0.05 * (right - left) + 0.5;
    left -= pad, right += pad;
    // Steep rays pass over little; wide enough that the relief is not drawn higher than a panel.
    const double least = overview_width / (highest_panel / (texels_per_height * (1 + below_floor + above_top)));
    if (right - left < least) {
        const double middle = (left + right) / 2;
        left = middle - least / 2, right = middle + least / 2;
    }
    return {left, right};
}

// What is to be seen up close: both hits and the last steps before them.
Window closeup_of(const Section& section, const Search& search, const Window& all) {
    double centre = section.truth.x, half = 1.25;
    if (search.has_found && std::abs(search.texels_off) < 0.4 * (all.right - all.left)) {
        centre = (section.truth.x + search.found.x) / 2;
        half = std::max(half, 0.8 * std::abs(search.texels_off));
    }
    // Wide enough for the bracket the search ended with: the last point above the surface and the first below it.
    const Step* above = nullptr;
    for (const Step& step : search.steps) {
        if (step.kind == StepKind::node || step.kind == StepKind::cell) continue;
        if (step.z <= step.value) break;
        above = &step;
    }
    if (above != nullptr) half = std::max(half, std::min(1.2 * std::abs(above->x - centre), 12.0));
    return {centre - std::min(half, (all.right - all.left) / 2), centre + std::min(half, (all.right - all.left) / 2)};
}

struct KindName {
    StepKind kind;
    const char* one;
    const char* many;
};
constexpr KindName kind_names[] = {
    {StepKind::sample, "sample", "samples"}, {StepKind::bisection, "bisection", "bisections"}, {StepKind::secant, "secant", "secants"},
    {StepKind::cone, "cone", "cones"},       {StepKind::sphere, "ball", "balls"},              {StepKind::node, "node", "nodes"},
    {StepKind::cell, "cell", "cells"},       {StepKind::normal, "normal", "normals"},          {StepKind::other, "other", "others"},
};

std::string counted(int n, const char* one, const char* many) { return std::to_string(n) + " " + (n == 1 ? one : many); }

// A swatch and what it means, if any search shows it.
struct Key {
    std::string words;
    std::function<void(Drawing&, Vec2d)> swatch;  // 22 pixels wide, centred on the point
};

std::vector<Key> keys_of(std::span<const Search> searches) {
    const auto any = [&](auto test) {
        return std::ranges::any_of(searches, [&](const Search& s) { return std::ranges::any_of(s.steps, test); });
    };
    const auto is_point = [](const Step& s) { return s.kind != StepKind::node && s.kind != StepKind::cell && s.kind != StepKind::normal; };
    const auto refines = [](const Step& s) { return s.kind == StepKind::bisection || s.kind == StepKind::secant; };
    const auto box = [](Ink ink, double fill, bool dashed) {
        return [=](Drawing& d, Vec2d p) {
            d.marks.push_back(Path{.points = {p + Vec2d{-10, 5}, p + Vec2d{-10, -5}, p + Vec2d{10, -5}, p + Vec2d{10, 5}}, .closed = true, .ink = ink, .width = 1.2, .fill = fill, .dashed = dashed});
        };
    };
    std::vector<Key> keys;
    keys.push_back({"ray from the eye", [](Drawing& d, Vec2d p) { d.marks.push_back(Path{.points = {p - Vec2d{10, 3}, p + Vec2d{10, 3}}, .ink = Ink::ray, .width = 1.5}); }});
    keys.push_back({"polygon", [](Drawing& d, Vec2d p) { d.marks.push_back(Path{.points = {p - Vec2d{11, 0}, p + Vec2d{11, 0}}, .ink = Ink::muted, .width = 1, .dashed = true}); }});
    keys.push_back({"first hit, exact", [](Drawing& d, Vec2d p) { d.marks.push_back(Dot{.centre = p, .radius = 6, .ink = Ink::truth, .hollow = true, .width = 1.8}); }});
    keys.push_back({"hit found", [](Drawing& d, Vec2d p) {
                        const double r = 4.6;
                        d.marks.push_back(Path{.points = {p + Vec2d{0, -r}, p + Vec2d{r, 0}, p + Vec2d{0, r}, p + Vec2d{-r, 0}}, .closed = true, .ink = Ink::found, .fill = 1});
                    }});
    const auto dot = [](Ink ink, bool hollow) {
        return [=](Drawing& d, Vec2d p) { d.marks.push_back(Dot{.centre = p, .radius = 3.2, .ink = ink, .hollow = hollow, .width = hollow ? 1.6 : 1}); };
    };
    if (any([&](const Step& s) { return is_point(s) && s.z > s.value; })) keys.push_back({"step above the surface", dot(Ink::above, false)});
    if (any([&](const Step& s) { return is_point(s) && s.z <= s.value; })) keys.push_back({"step below it", dot(Ink::below, false)});
    if (any(refines)) keys.push_back({"refinement (hollow)", dot(Ink::above, true)});
    if (std::ranges::any_of(searches, [](const Search& s) { return !s.chord.empty(); }))
        keys.push_back({"line taken for the surface", [](Drawing& d, Vec2d p) { d.marks.push_back(Path{.points = {p + Vec2d{-10, 4}, p + Vec2d{10, -4}}, .ink = Ink::secant, .width = 1.8}); }});
    if (any([](const Step& s) { return s.kind == StepKind::cone; }))
        keys.push_back({"cone over a texel", [](Drawing& d, Vec2d p) {
                            const std::vector<Vec2d> v{p + Vec2d{-10, -6}, p + Vec2d{0, 6}, p + Vec2d{10, -6}};
                            d.marks.push_back(Path{.points = v, .closed = true, .ink = Ink::cone, .fill = 0.10});
                            d.marks.push_back(Path{.points = v, .ink = Ink::cone, .width = 1});
                        }});
    if (any([](const Step& s) { return s.kind == StepKind::sphere; }))
        keys.push_back({"empty ball", [](Drawing& d, Vec2d p) { d.marks.push_back(Dot{.centre = p, .radius = 6, .ink = Ink::sphere, .hollow = true, .width = 1}); }});
    if (any([](const Step& s) { return s.kind == StepKind::node && s.skipped; })) keys.push_back({"node passed over", box(Ink::node, 0.10, false)});
    if (any([](const Step& s) { return s.kind == StepKind::node && !s.skipped; })) keys.push_back({"node opened", box(Ink::opened, 0, true)});
    if (any([](const Step& s) { return s.kind == StepKind::cell && s.skipped; })) keys.push_back({"cell passed over", box(Ink::cell, 0.10, false)});
    if (any([](const Step& s) { return s.solved; })) keys.push_back({"cell solved", box(Ink::cell, 0.25, false)});
    if (any([](const Step& s) { return s.kind == StepKind::normal; }))
        keys.push_back({"slope from the normal map", [](Drawing& d, Vec2d p) { d.marks.push_back(Path{.points = {p + Vec2d{-10, 3}, p + Vec2d{10, -3}}, .ink = Ink::normal, .width = 2.2}); }});
    return keys;
}

// The keys in lines; returns where the next thing may stand.
double draw_keys(Drawing& drawing, std::span<const Search> searches, double y) {
    double x = margin;
    for (const Key& key : keys_of(searches)) {
        const double width = 30 + text_width(key.words, 11, false) + 18;
        if (x + width > figure_width - margin + 18) x = margin, y += 20;
        key.swatch(drawing, {x + 12, y - 4});
        drawing.marks.push_back(Label{.at = {x + 30, y}, .text = key.words, .ink = Ink::muted, .size = 11});
        x += width;
    }
    return y + 20;
}

std::string settings_of(const Search& search) {
    std::string words;
    for (const KnobDefault& k : search.technique->knobs) words += (words.empty() ? "" : ", ") + std::string(k.knob->id) + " = " + text("%.6g", static_cast<double>(k.knob->get(search.params)));
    return words;
}

}  // namespace

std::string search_sentence(const Search& search) {
    std::string words = search.fetches == 0 ? "no fetch" : counted(search.fetches, "fetch", "fetches");
    std::string parts;
    for (const KindName& k : kind_names) {
        const auto n = static_cast<int>(std::ranges::count(search.steps, k.kind, &Step::kind));
        if (n > 0) parts += (parts.empty() ? "" : ", ") + counted(n, k.one, k.many);
    }
    if (!parts.empty()) words += " (" + parts + ")";
    if (!search.has_found) return words + "; finds no surface";
    words += "; stops at height " + text("%.3f", search.found.z);
    const double off = std::abs(search.texels_off);
    if (off < 0.0005) return words + ", on the first hit";
    return words + ", " + text(off < 0.095 ? "%.3f" : off < 9.95 ? "%.2f" : "%.0f", off) + " texels " + (search.texels_off > 0 ? "behind" : "before") + " the first hit";
}

Drawing search_figure(const Section& section, std::span<const Search> searches, const HeightField& field, const SearchFigure& settings) {
    const double texels_per_height = static_cast<double>(section.question.height_scale) * section.texels_per_uv;
    const Window window = window_of(section, searches, texels_per_height);
    const double px_per_texel = overview_width / (window.right - window.left);
    const double slab = 1 + below_floor + above_top;
    const double true_height = px_per_texel * texels_per_height * slab;
    const double panel_height = std::clamp(true_height, lowest_panel, highest_panel);
    const double exaggeration = panel_height / true_height;

    Drawing drawing;
    drawing.width = figure_width;
    drawing.title = settings.heading;
    drawing.marks.push_back(Label{.at = {margin, 32}, .text = settings.heading, .ink = Ink::text, .size = 17, .bold = true});
    drawing.marks.push_back(Label{.at = {margin, 52}, .text = settings.where, .ink = Ink::muted, .size = 11.5});
    std::string scales = "Across: texels along the ray from where it enters. Up: height, ";
    scales += std::abs(exaggeration - 1) < 0.02 ? "to scale." : "drawn " + text("%.2g", exaggeration) + " times as high as it is.";
    scales += " First hit at height " + text("%.3f", section.truth.z) + " after " + text("%.1f", section.truth.x) + " texels.";
    drawing.marks.push_back(Label{.at = {margin, 69}, .text = scales, .ink = Ink::muted, .size = 11.5});

    double y = draw_keys(drawing, searches, 94);
    for (const Search& search : searches) {
        y += 14;
        const std::string title(search.technique->title);
        drawing.marks.push_back(Label{.at = {margin, y}, .text = title, .ink = Ink::text, .size = 14, .bold = true});
        drawing.marks.push_back(Label{.at = {margin + text_width(title, 14, true) + 12, y}, .text = settings_of(search), .ink = Ink::muted, .size = 11.5});
        y += 18;
        const std::string sentence = search_sentence(search);
        drawing.marks.push_back(Label{.at = {margin, y}, .text = sentence, .ink = Ink::text, .size = 12});
        drawing.description += (drawing.description.empty() ? "" : " ") + title + ": " + sentence + ".";
        y += 10;

        const double left = margin + axis_room, right = figure_width - margin;
        Panel overview{.box = {left, y, left + overview_width, y + panel_height}, .x_left = window.left, .x_right = window.right, .z_bottom = -below_floor, .z_top = 1 + above_top};
        const Window near = closeup_of(section, search, window);
        Panel closeup{.box = {right - closeup_width, y, right, y + panel_height}, .x_left = near.left, .x_right = near.right};
        const double heights = panel_height / (closeup.px_per_texel() * overview.px_per_height() / overview.px_per_texel());
        const double middle = section.ray_height((near.left + near.right) / 2);
        closeup.z_bottom = middle - heights / 2, closeup.z_top = middle + heights / 2;
        const Vec2d a = overview.at(near.left, closeup.z_top), b = overview.at(near.right, closeup.z_bottom);
        overview.frame = Rect{a.x, a.y, b.x, b.y};

        draw_axes(drawing, overview, true);
        draw_panel(drawing, overview, section, field, search, PanelText::where_apart);
        draw_axes(drawing, closeup, false);
        draw_panel(drawing, closeup, section, field, search, PanelText::always);
        y += panel_height + 30;
    }
    drawing.height = y + 6;
    return drawing;
}

}  // namespace relievo
