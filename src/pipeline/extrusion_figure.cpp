#include "pipeline/extrusion_figure.h"

#include "mesh/normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>

namespace relievo {

namespace {

constexpr double panel_width = 300, panel_height = 300, text_height = 48, margin = 10;
constexpr double unit_pixels = 48;  // so that the outermost shell of the most crooked mode stays in its panel
constexpr std::array heights{0.3f, 0.6f, 0.9f};

Mesh cube() {
    Mesh mesh;
    for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f);
    mesh.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    return mesh;
}

// The corners of each side, counter-clockwise from outside: the lines between its two triangles would only clutter the figure.
constexpr std::array<std::array<std::size_t, 4>, 6> sides{{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};

// A little from the right and above.
const Vec3d towards_eye = normalize(Vec3d(0.55, 0.42, 1));
const Vec3d right = normalize(cross(Vec3d(0, 1, 0), towards_eye));
const Vec3d up = cross(towards_eye, right);

void add_sides(Drawing& drawing, const Mesh& mesh, Vec2d centre, Ink ink, double width, double fill) {
    for (const auto& corners : sides) {
        Path side{.points = {}, .closed = true, .ink = ink, .width = width, .opacity = 1, .fill = fill};
        std::array<Vec3d, 4> p;
        for (std::size_t k = 0; k < 4; ++k) {
            p[k] = Vec3d(mesh.positions[corners[k]]);
            side.points.emplace_back(centre.x + unit_pixels * dot(p[k], right), centre.y - unit_pixels * dot(p[k], up));
        }
        if (dot(cross(p[2] - p[0], p[3] - p[1]), towards_eye) > 0) drawing.marks.emplace_back(std::move(side));
    }
}

// The largest angle between a normal and the diagonal that its corner lies on, degrees.
double off_diagonal(const Mesh& mesh, const std::vector<Vec3f>& normals) {
    double worst = 0;
    for (std::size_t v = 0; v < normals.size(); ++v) {
        const Vec3d n(normals[v]), d = normalize(Vec3d(mesh.positions[v]));
        worst = std::max(worst, std::atan2(length(cross(n, d)), dot(n, d)) * 180 / std::numbers::pi);
    }
    return worst;
}

}  // namespace

Drawing extrusion_figure() {
    Drawing drawing;
    drawing.title = "A cube pushed out along its continuous normals, by mode";
    const Mesh base = cube();
    double left = margin;
    for (const NormalModeEntry& mode : normal_modes) {
        if (mode.mode == NormalMode::none) continue;
        const std::vector<Vec3f> normals = continuous_normals(base, mode.mode);
        const Vec2d centre(left + panel_width / 2, margin + panel_height / 2);
        add_sides(drawing, base, centre, Ink::muted, 0.8, 0.25);
        for (const float height : heights) {
            Mesh shell = base;
            for (std::size_t v = 0; v < normals.size(); ++v) shell.positions[v] += normals[v] * (height * std::sqrt(3.0f));
            add_sides(drawing, shell, centre, Ink::surface, height == heights.back() ? 1.6 : 0.8, 0);
        }
        char text[64];
        std::snprintf(text, sizeof text, "normals off the diagonals by %.1f degrees", off_diagonal(base, normals));
        drawing.marks.emplace_back(Label{{centre.x, margin + panel_height + 14}, std::string(mode.id), Ink::text, 14, Anchor::middle, true});
        drawing.marks.emplace_back(Label{{centre.x, margin + panel_height + 34}, text, Ink::muted, 12, Anchor::middle, false});
        left += panel_width + margin;
    }
    drawing.description = "Pushed out by the sum of all normals at a corner the sides lean; counted once or weighed by angle they stay straight.";
    drawing.width = left;
    drawing.height = 2 * margin + panel_height + text_height;
    return drawing;
}

}  // namespace relievo
