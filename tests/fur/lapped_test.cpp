// Lapped patches on surfaces whose answer is known: a flat sheet, on which a patch is the sheet itself, and a ball.
#include "fur/lapped.h"

#include "fur/comb.h"
#include "fur/evenness.h"
#include "fur/facing.h"
#include "fur/fur_map.h"
#include "mesh/made_up_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace relievo {
namespace {

// A square of edge 2 in the plane z = 0, combed along (1, 1, 0).
Mesh sheet(std::uint32_t n) {
    Mesh mesh;
    for (std::uint32_t y = 0; y <= n; ++y)
        for (std::uint32_t x = 0; x <= n; ++x) mesh.positions.emplace_back(2 * static_cast<float>(x) / static_cast<float>(n) - 1, 2 * static_cast<float>(y) / static_cast<float>(n) - 1, 0.0f);
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x, b = a + n + 1;
            mesh.indices.insert(mesh.indices.end(), {a, a + 1, b + 1, a, b + 1, b});
        }
    mesh.normals.assign(mesh.positions.size(), {0, 0, 1});
    return mesh;
}

Mesh ball() {
    Mesh mesh = made_up_scan({.faces = 8000, .relief = 0, .noise = 0});
    mesh.normals = mesh.positions;
    for (Vec3f& n : mesh.normals) n = normalize(n);
    return mesh;
}

double area_of(const Mesh& mesh, std::uint32_t f) { return length(face_vector(mesh, f)) / 2; }
double uv_area_of(const Mesh& mesh, std::uint32_t f) {
    const std::uint32_t* v = &mesh.indices[std::size_t{f} * 3];
    const Vec2d a(mesh.uvs[v[0]].x, mesh.uvs[v[0]].y), b(mesh.uvs[v[1]].x, mesh.uvs[v[1]].y), c(mesh.uvs[v[2]].x, mesh.uvs[v[2]].y);
    return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
}

void expect_everything_pasted(const Lapped& l, const Mesh& mesh) {
    std::set<std::uint32_t> pasted(l.face_of.begin(), l.face_of.end());
    EXPECT_EQ(pasted.size(), mesh.faces());
    ASSERT_EQ(l.face_of.size(), l.mesh.faces());
    for (std::uint32_t f = 0; f < l.mesh.faces(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            // Corners in their order, so that layers of several patches coincide bit by bit.
            ASSERT_EQ(l.mesh.positions[l.mesh.indices[f * std::size_t{3} + k]], mesh.positions[mesh.indices[l.face_of[f] * std::size_t{3} + k]]);
        }
}

TEST(Lapped, OnASheetEachPatchIsTheSheetTurnedToTheComb) {
    const Mesh mesh = sheet(40);
    const std::vector<Vec3f> comb(mesh.positions.size(), normalize(Vec3f(1, 1, 0)));
    const double radius = 0.4;
    const Lapped l = lapped(mesh, comb, {.radius = radius});
    expect_everything_pasted(l, mesh);
    EXPECT_GT(l.patches, 6u);
    EXPECT_GE(l.pasted_area, 1);
    EXPECT_LT(l.pasted_area, 2.2);
    const double scale = 4 * radius * radius;
    for (std::uint32_t f = 0; f < l.mesh.faces(); ++f) {
        ASSERT_NEAR(uv_area_of(l.mesh, f) * scale, area_of(l.mesh, f), 0.02 * area_of(l.mesh, f));
        // u runs along the comb.
        const std::uint32_t* v = &l.mesh.indices[std::size_t{f} * 3];
        const Vec3f way = l.mesh.positions[v[1]] - l.mesh.positions[v[0]];
        ASSERT_NEAR(l.mesh.uvs[v[1]].x - l.mesh.uvs[v[0]].x, dot(way, comb[0]) / (2 * radius), 1e-3);
    }
    const Image8 texture = patch_texture(64, 0.3, 1);
    const MapStrands grown = lapped_strands(l, mesh, texture);
    // As dense as the texture where no patches lap, up to twice as dense where they do, and the same strands again and again.
    const double per_area = 0.3 * 64 * 64 / scale, density = static_cast<double>(grown.roots.roots.size()) / 4;
    EXPECT_GT(density, per_area);
    EXPECT_LT(density, 1.8 * per_area);
    const Evenness e = evenness(mesh, grown.roots, grown.strands, {.extent = 1});
    EXPECT_LT(e.density_p95_over_p5, 3);
    EXPECT_GT(e.shared_texel_area, 0.9);
}

TEST(Lapped, CoversABallWithLittleDistortion) {
    const Mesh mesh = ball();
    const Lapped l = lapped(mesh, combed(mesh, 0), {.radius = 0.35});
    expect_everything_pasted(l, mesh);
    std::vector<double> stretch;
    for (std::uint32_t f = 0; f < l.mesh.faces(); ++f) stretch.push_back(uv_area_of(l.mesh, f) * 4 * 0.35 * 0.35 / area_of(l.mesh, f));
    std::ranges::sort(stretch);
    EXPECT_NEAR(stretch[stretch.size() / 2], 1, 0.1);
    EXPECT_GT(stretch[stretch.size() / 20], 0.7);
    EXPECT_LT(stretch[stretch.size() * 19 / 20], 1.4);
    const Image8 texture = patch_texture(64, 0.3, 1);
    const MapStrands grown = lapped_strands(l, mesh, texture);
    EXPECT_LT(evenness(mesh, grown.roots, grown.strands, {.extent = 1}).density_p95_over_p5, 4);
    for (std::size_t i = 0; i < grown.roots.roots.size(); i += 50) EXPECT_NEAR(length(grown.roots.roots[i].position), 1, 0.01);
}

TEST(Lapped, IsItsSeedsAndStandsOddMeshes) {
    const Mesh mesh = ball();
    const std::vector<Vec3f> comb = combed(mesh, 0);
    const Lapped a = lapped(mesh, comb, {.radius = 0.5, .seed = 2}), b = lapped(mesh, comb, {.radius = 0.5, .seed = 2}), c = lapped(mesh, comb, {.radius = 0.5, .seed = 3});
    EXPECT_EQ(a.face_of, b.face_of);
    EXPECT_NE(a.face_of, c.face_of);
    // Faces larger than a patch, faces without area, two sheets that share an edge the wrong way round.
    Mesh odd = sheet(1);
    odd.positions.emplace_back(0.0f, -1.0f, 1.0f);
    odd.normals.emplace_back(0.0f, 1.0f, 0.0f);
    odd.indices.insert(odd.indices.end(), {0, 1, 4, 0, 1, 4, 1, 0, 4});
    odd.positions.emplace_back(0.5f, -1.0f, 0.0f);
    odd.normals.emplace_back(0.0f, 0.0f, 0.0f);
    odd.indices.insert(odd.indices.end(), {0, 1, 5});
    const Lapped l = lapped(odd, std::vector<Vec3f>(odd.positions.size()), {.radius = 0.1});
    EXPECT_EQ(l.mesh.faces(), 5u);  // all but the one without area
    for (const Vec2f& uv : l.mesh.uvs) EXPECT_TRUE(std::isfinite(uv.x) && std::isfinite(uv.y));
}

TEST(PatchTexture, IsWholeInsideAndEmptyOutside) {
    const Image8 texture = patch_texture(64, 0.4, 5);
    const FurMap map = fur_map({.width = 64, .height = 64, .density = 0.4, .seed = 5});
    int kept = 0, between = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const double r = std::hypot((2 * x + 1) / 64.0 - 1, (2 * y + 1) / 64.0 - 1);
            if (r <= blob_inside) { ASSERT_EQ(texture(x, y, 3), map.texels(x, y, 3)); }
            if (r > 1) { ASSERT_EQ(texture(x, y, 3), 0); }
            if (r > blob_inside && r <= 1 && map.texels(x, y, 3) > 0) {
                ++between;
                kept += texture(x, y, 3) > 0;
            }
            ASSERT_EQ(texture(x, y, 0), 255);
        }
    EXPECT_NEAR(static_cast<double>(kept) / between, 0.5, 0.2);
}

}  // namespace
}  // namespace relievo
