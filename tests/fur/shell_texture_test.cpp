// One texture for all layers: the cone of a strand, read back as heights.
#include "fur/shell_texture.h"

#include "fur/strand_grid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relievo {
namespace {

// A square metre that looks up, and its atlas.
struct Lawn {
    Mesh mesh;
    ChartAtlas atlas;
    Lawn() {
        mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}};
        mesh.normals.assign(4, {0, 1, 0});
        mesh.indices = {0, 1, 2, 0, 2, 3};
        atlas = chart_atlas(mesh, 256);
    }
    // The place on the lawn that a texel shows: the square's first corner and sides, by the coordinates it was given.
    Vec2d place(int x, int y) const {
        const auto at = [&](std::uint32_t v) { return Vec2d(atlas.mesh.uvs[v]) * 256.0; };
        std::uint32_t corner = 0, along_x = 0, along_z = 0;
        for (std::uint32_t v = 0; v < atlas.vertex.size(); ++v) {
            if (atlas.vertex[v] == 0) corner = v;
            if (atlas.vertex[v] == 3) along_x = v;
            if (atlas.vertex[v] == 1) along_z = v;
        }
        const Vec2d e = Vec2d(x + 0.5, y + 0.5) - at(corner), i = at(along_x) - at(corner), j = at(along_z) - at(corner);
        return {dot(e, i) / dot(i, i), dot(e, j) / dot(j, j)};
    }
};

TEST(ShellTexture, AlphaIsTheHeightOfTheCone) {
    const Lawn lawn;
    Roots one;
    one.roots = {{{0.5f, 0, 0.5f}, 0}};
    // A cone (taper 0) of full height, 0.2 wide at its foot.
    const Coat coat{.length = 0.3f, .spread = 0, .width = 0.2f, .taper = 0, .length_variation = 0, .guard_hairs = 0};
    const ShellTexture t = shell_texture(lawn.atlas, lawn.mesh, one, coat, 1, 0);
    int inside = 0;
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x) {
            const Vec2d p = lawn.place(x, y);
            if (std::min(p.x, p.y) < 0 || std::max(p.x, p.y) > 1) continue;
            const double away = length(p - Vec2d(0.5, 0.5)), height = std::max(0.0, 1 - away / 0.2);
            inside += height > 0;
            ASSERT_NEAR(t.texels(x, y, 3) / 255.0, height, 0.003) << x << ' ' << y;
        }
    EXPECT_GT(inside, 3000);
    EXPECT_NEAR(t.covered, 3.14159 * 0.04, 0.003);
}

TEST(ShellTexture, ShortStrandsEndBelowAndThreadsChangeNothing) {
    const Lawn lawn;
    const Roots roots = grow_roots(lawn.mesh, {.count = 300});
    const Coat coat{.length = 0.2f, .spread = 0.02f, .width = 0.3f, .length_variation = 0.6f, .guard_hairs = 0};
    const double spacing = std::sqrt(1.0 / static_cast<double>(roots.roots.size()));
    const ShellTexture t = shell_texture(lawn.atlas, lawn.mesh, roots, coat, spacing, 0, 1);
    EXPECT_EQ(t.texels.texels, shell_texture(lawn.atlas, lawn.mesh, roots, coat, spacing, 0, 3).texels.texels);
    // At each root its own strand ends, or a neighbour that is thick enough to reach over.
    std::vector<double> highest(roots.roots.size(), 0.0);
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x) {
            const Vec2d p = lawn.place(x, y);
            for (std::size_t r = 0; r < roots.roots.size(); ++r)
                if (length(p - Vec2d(roots.roots[r].position.x, roots.roots[r].position.z)) < 0.9 * static_cast<double>(coat.width) * spacing)
                    highest[r] = std::max(highest[r], t.texels(x, y, 3) / 255.0);
        }
    for (std::size_t r = 0; r < roots.roots.size(); ++r) {
        const double tip = 1 - 0.6 * (strand_chance(roots.roots[r].position) & 255u) / 255.0;
        ASSERT_GT(highest[r], tip - 0.25);
    }
    EXPECT_NEAR(t.covered, 3.14159 * 0.09, 0.05);
}

}  // namespace
}  // namespace relievo
