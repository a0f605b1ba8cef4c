#include "mesh/made_up_atlas.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace relievo {

namespace {

constexpr double tau = 2 * std::numbers::pi;

struct Point {
    Vec3d position, normal;
};

struct Rectangle {
    Vec2d low, high;
};

// A grid over a rectangle of the picture. `at` takes coordinates in [0,1]^2, along u and v.
void add_patch(Mesh& mesh, Rectangle where, int across, int up, const std::function<Point(double, double)>& at) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int j = 0; j <= up; ++j) {
        for (int i = 0; i <= across; ++i) {
            const double a = static_cast<double>(i) / across;
            const double b = static_cast<double>(j) / up;
            const Point p = at(a, b);
            mesh.positions.push_back(Vec3f(p.position));
            mesh.normals.push_back(Vec3f(normalize(p.normal)));
            mesh.uvs.push_back(Vec2f{static_cast<float>(where.low.x + a * (where.high.x - where.low.x)), static_cast<float>(where.low.y + b * (where.high.y - where.low.y))});
        }
    }
    const auto row = static_cast<std::uint32_t>(across + 1);
    for (std::uint32_t j = 0; j < static_cast<std::uint32_t>(up); ++j) {
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(across); ++i) {
            const std::uint32_t v = first + j * row + i;
            for (const std::uint32_t index : {v, v + 1, v + row + 1, v, v + row + 1, v + row}) mesh.indices.push_back(index);
        }
    }
}

Mesh cube() {
    Mesh mesh{.name = "cube"};
    struct Side {
        Vec3d right, up;
    };
    const Side sides[] = {{{1, 0, 0}, {0, 1, 0}}, {{-1, 0, 0}, {0, 1, 0}}, {{0, 0, -1}, {0, 1, 0}},
                          {{0, 0, 1}, {0, 1, 0}}, {{1, 0, 0}, {0, 0, -1}}, {{1, 0, 0}, {0, 0, 1}}};
    // Three columns and three rows of squares, a gap between them; the last row stays empty.
    constexpr double edge = 0.3, pitch = 1.0 / 3, margin = (pitch - edge) / 2;
    for (int k = 0; k < 6; ++k) {
        const Vec2d low{k % 3 * pitch + margin, k / 3 * pitch + margin};
        const Side s = sides[k];
        const Vec3d out = cross(s.right, s.up);
        add_patch(mesh, {low, low + Vec2d{edge, edge}}, 2, 2,
                  [&](double a, double b) { return Point{out * 0.5 + s.right * (a - 0.5) + s.up * (b - 0.5), out}; });
    }
    return mesh;
}

Mesh cylinder() {
    Mesh mesh{.name = "cylinder"};
    constexpr double radius = 0.5, height = 1;
    constexpr double unit = 0.96 / (tau * radius);  // of the picture per unit of the mesh
    add_patch(mesh, {{0.02, 0.02}, {0.98, 0.02 + height * unit}}, 96, 4, [](double a, double b) {
        const Vec3d n{std::cos(tau * a), 0, -std::sin(tau * a)};
        return Point{n * radius + Vec3d{0, (b - 0.5) * height, 0}, n};
    });
    for (const double side : {1.0, -1.0}) {
        const Vec2d centre{side > 0 ? 0.25 : 0.75, 0.65};
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        constexpr std::uint32_t corners = 96;
        const auto add = [&](Vec2d p) {
            mesh.positions.push_back(Vec3f(Vec3d{p.x, side * height / 2, -side * p.y}));
            mesh.normals.push_back({0, static_cast<float>(side), 0});
            mesh.uvs.push_back(Vec2f(centre + p * unit));
        };
        add({0, 0});
        for (std::uint32_t i = 0; i < corners; ++i) add(Vec2d{std::cos(tau * i / corners), std::sin(tau * i / corners)} * radius);
        for (std::uint32_t i = 0; i < corners; ++i)
            for (const std::uint32_t index : {first, first + 1 + i, first + 1 + (i + 1) % corners}) mesh.indices.push_back(index);
    }
    return mesh;
}

Mesh torus() {
    Mesh mesh{.name = "torus"};
    constexpr double ring = 0.6, tube = 0.25;
    constexpr double unit = 0.96 / (tau * ring / 2);  // each chart is half of the ring, and half of the tube
    constexpr double tall = tau * tube / 2 * unit;
    for (int k = 0; k < 4; ++k) {
        const double low = 0.01 + k * 0.245;
        static_assert(4 * 0.245 <= 0.99);
        constexpr double squeezed = 0.235;  // four rows fit where the charts would be `tall` each
        add_patch(mesh, {{0.02, low}, {0.98, low + std::min(tall, squeezed)}}, 64, 24, [&](double a, double b) {
            const double along = tau * (a + k % 2) / 2;
            const double round = tau * (b + k / 2) / 2;
            const Vec3d out{std::cos(along), 0, -std::sin(along)};
            const Vec3d n = out * std::cos(round) + Vec3d{0, std::sin(round), 0};
            return Point{out * ring + n * tube, n};
        });
    }
    return mesh;
}

constexpr UnwrappedShape shapes[] = {
    {"cube", "six flat charts", &cube},
    {"cylinder", "one chart bent one way, and two flat discs", &cylinder},
    {"torus", "four charts bent both ways", &torus},
};

}  // namespace

std::span<const UnwrappedShape> unwrapped_shapes() { return shapes; }

const UnwrappedShape* find_unwrapped_shape(std::string_view id) {
    const auto it = std::ranges::find(shapes, id, &UnwrappedShape::id);
    return it == std::end(shapes) ? nullptr : it;
}

}  // namespace relievo
