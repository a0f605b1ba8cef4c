// Charts: every face where it belongs, at one scale, and no texel shared.
#include "mesh/chart_atlas.h"

#include "core/error.h"
#include "mesh/made_up_scan.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace relievo {
namespace {

double twice_area(Vec2d a, Vec2d b, Vec2d c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

// Also counts how many faces each texel's centre is well within.
void expect_sound(const Mesh& mesh, const ChartAtlas& atlas) {
    ASSERT_EQ(atlas.mesh.indices.size(), mesh.indices.size());
    ASSERT_EQ(atlas.vertex.size(), atlas.mesh.positions.size());
    ASSERT_EQ(atlas.mesh.uvs.size(), atlas.mesh.positions.size());
    std::vector<int> owners(static_cast<std::size_t>(atlas.size) * static_cast<std::size_t>(atlas.size), 0);
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        std::array<Vec2d, 3> c;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = atlas.mesh.indices[3 * f + k];
            ASSERT_EQ(atlas.vertex[v], mesh.indices[3 * f + k]);
            ASSERT_EQ(atlas.mesh.positions[v], mesh.positions[atlas.vertex[v]]);
            c[k] = Vec2d(atlas.mesh.uvs[v]) * static_cast<double>(atlas.size);
            // The gutter is kept.
            ASSERT_GE(std::min(c[k].x, c[k].y), atlas.gutter - 1e-2);
            ASSERT_LE(std::max(c[k].x, c[k].y), atlas.size - atlas.gutter + 1e-2);
        }
        // Seen from its own side, and not stretched beyond what the steepest slope allows: 4 by area.
        const Vec3d a(mesh.positions[mesh.indices[3 * f]]);
        const double space = length(cross(Vec3d(mesh.positions[mesh.indices[3 * f + 1]]) - a, Vec3d(mesh.positions[mesh.indices[3 * f + 2]]) - a)) / (atlas.texel * atlas.texel);
        const double flat = twice_area(c[0], c[1], c[2]);
        if (space > 0.5) {
            ASSERT_GT(flat, space / 4.2);
            ASSERT_LT(flat, space * 1.02 + 0.05);
        }
        for (int y = static_cast<int>(std::min({c[0].y, c[1].y, c[2].y})); y <= static_cast<int>(std::max({c[0].y, c[1].y, c[2].y})); ++y)
            for (int x = static_cast<int>(std::min({c[0].x, c[1].x, c[2].x})); x <= static_cast<int>(std::max({c[0].x, c[1].x, c[2].x})); ++x) {
                const Vec2d p(x + 0.5, y + 0.5);
                // Rounding of coordinates to floats apart.
                if (std::min({twice_area(c[0], c[1], p), twice_area(c[1], c[2], p), twice_area(c[2], c[0], p)}) > 0.02) ++owners[static_cast<std::size_t>(y * atlas.size + x)];
            }
    }
    std::size_t shared = 0;
    for (const int o : owners) shared += o > 1;
    EXPECT_EQ(shared, 0u);
}

TEST(ChartAtlas, ACubeIsSixSquares) {
    Mesh cube;
    for (int i = 0; i < 8; ++i) cube.positions.push_back({static_cast<float>(i & 1), static_cast<float>(i >> 1 & 1), static_cast<float>(i >> 2)});
    cube.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    const ChartAtlas atlas = chart_atlas(cube, 256);
    EXPECT_EQ(atlas.charts, 6);
    EXPECT_EQ(atlas.mesh.positions.size(), 24u);
    // Three columns of squares of 79 texels and their gutters are the best a square of 256 holds; shelves and steps of 4 % cost a little of it.
    EXPECT_GT(1 / atlas.texel, 72);
    expect_sound(cube, atlas);
}

TEST(ChartAtlas, AScanIsParted) {
    const Mesh mesh = made_up_scan({.faces = 6000, .relief = 0.5, .noise = 0.3});
    const ChartAtlas atlas = chart_atlas(mesh, 1024);
    EXPECT_GE(atlas.charts, 6);
    expect_sound(mesh, atlas);
}

TEST(ChartAtlas, WhatFoldsOverItselfIsParted) {
    // A ramp winding up round the y axis for two turns: seen from above one turn lies over the other, and all of it hangs together.
    Mesh ramp;
    constexpr int steps = 96;
    for (int i = 0; i <= steps; ++i) {
        const double angle = i * 4 * 3.14159265358979 / steps, height = i * 0.5 / steps;
        for (const double r : {0.6, 1.0}) ramp.positions.push_back(Vec3f(Vec3d(r * std::cos(angle), height, -r * std::sin(angle))));
    }
    for (std::uint32_t i = 0; i < steps; ++i) ramp.indices.insert(ramp.indices.end(), {2 * i, 2 * i + 1, 2 * i + 2, 2 * i + 2, 2 * i + 1, 2 * i + 3});
    const ChartAtlas atlas = chart_atlas(ramp, 256);
    EXPECT_GE(atlas.charts, 2);
    expect_sound(ramp, atlas);
}

TEST(ChartAtlas, SaysWhenThereIsNoRoom) {
    // Five thousand islands, and room for their gutters alone is missing.
    Mesh islands;
    islands.name = "islands";
    for (std::uint32_t i = 0; i < 5000; ++i) {
        const float x = static_cast<float>(i);
        islands.positions.insert(islands.positions.end(), {{x, 0, 0}, {x + 0.5f, 0, 0}, {x, 0, -0.5f}});
        islands.indices.insert(islands.indices.end(), {3 * i, 3 * i + 1, 3 * i + 2});
    }
    EXPECT_THROW(chart_atlas(islands, 64), Error);
    expect_sound(islands, chart_atlas(islands, 1024));
}

}  // namespace
}  // namespace relievo
