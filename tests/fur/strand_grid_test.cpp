// The grid against looking at every root.
#include "fur/strand_grid.h"

#include "fur/coat.h"
#include "fur/comb.h"
#include "fur/facing.h"
#include "fur/lock_noise.h"
#include "mesh/made_up_scan.h"
#include "mesh/normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace relievo {
namespace {

// The place of a listed root, as the program that draws decodes it.
Vec3d place_of(const ListedRoot& root, const std::array<int, 3>& cell, const StrandGrid& grid) {
    const auto at = [&](std::uint32_t bits, int c) { return (c - 1 + (bits & 1023u) * 3 / 1023.0) / static_cast<double>(grid.cells_per_unit); };
    return Vec3d(grid.low) + Vec3d(at(root[0], cell[0]), at(root[0] >> 10, cell[1]), at(root[0] >> 20, cell[2]));
}

TEST(StrandGrid, FindsEveryRootInReach) {
    const Mesh mesh = made_up_scan({.faces = 8000});
    const Roots roots = grow_roots(mesh, {.count = 3000});
    const auto reach = static_cast<float>(1.7 * std::sqrt(roots.area / 3000));
    const float off = 0.3f * reach;
    const StrandGrid grid = strand_grid(mesh, roots, {.reach = reach, .off = off});
    ASSERT_EQ(grid.starts.size() % 512, 1u);
    const double step = 3 / (1023.0 * static_cast<double>(grid.cells_per_unit));
    const Roots places = grow_roots(mesh, {.count = 400, .seed = 9});
    std::size_t looked_for = 0, listed = 0;
    for (const Root& place : places.roots) {
        const Vec3f in_cells = (place.position - grid.low) * grid.cells_per_unit;
        const std::array<int, 3> cell{static_cast<int>(in_cells.x), static_cast<int>(in_cells.y), static_cast<int>(in_cells.z)};
        const int brick = (cell[0] >> 3) + grid.size[0] * ((cell[1] >> 3) + grid.size[1] * (cell[2] >> 3));
        const std::size_t c = grid.bricks[static_cast<std::size_t>(brick)] * std::size_t{512} + static_cast<std::size_t>((cell[0] & 7) | (cell[1] & 7) << 3 | (cell[2] & 7) << 6);
        std::vector<std::pair<Vec3d, std::uint32_t>> found;
        for (std::uint32_t i = grid.starts[c]; i < grid.starts[c + 1]; ++i) found.emplace_back(place_of(grid.lists[i], cell, grid), grid.lists[i][1]);
        listed += found.size();
        for (const Root& root : roots.roots) {
            const Vec3d gap = Vec3d(root.position) - Vec3d(place.position), n = normalize(face_vector(mesh, root.face));
            const double across = std::abs(dot(gap, n));
            if (across > static_cast<double>(off) || dot(gap, gap) - across * across > 0.998 * static_cast<double>(reach * reach)) continue;
            ++looked_for;
            EXPECT_TRUE(std::ranges::any_of(found, [&](const auto& f) { return length(f.first - Vec3d(root.position)) < step && f.second >> 16 == strand_chance(root.position); }));
        }
    }
    EXPECT_GT(looked_for, 400u * 4);
    EXPECT_LT(listed, looked_for * 8);  // or the loop over a list would be mostly in vain
}

TEST(StrandGrid, IsTheSameForAnyThreads) {
    const Mesh mesh = made_up_scan({.faces = 8000});
    const Roots roots = grow_roots(mesh, {.count = 20000});
    const StrandGrid one = strand_grid(mesh, roots, {.reach = 0.03f, .threads = 1}), many = strand_grid(mesh, roots, {.reach = 0.03f, .threads = 5});
    EXPECT_EQ(one.bricks, many.bricks);
    EXPECT_EQ(one.starts, many.starts);
    EXPECT_EQ(one.lists, many.lists);
}

TEST(StrandGrid, NormalsSurvivePacking) {
    for (int i = 0; i < 500; ++i) {
        const double z = 2 * (i + 0.5) / 500 - 1, a = i * 2.399963, r = std::sqrt(1 - z * z);
        const Vec3d n(r * std::cos(a), r * std::sin(a), z);
        const std::uint32_t bits = packed_normal(n * 3.0);
        double x = (bits & 255u) * 2 / 255.0 - 1, y = (bits >> 8) * 2 / 255.0 - 1;
        Vec3d back(x, y, 1 - std::abs(x) - std::abs(y));
        const double t = std::max(-back.z, 0.0);
        back.x += back.x >= 0 ? -t : t;
        back.y += back.y >= 0 ? -t : t;
        EXPECT_GT(dot(normalize(back), n), std::cos(0.02)) << i;
    }
}

TEST(Comb, LiesInTheSkinAndLeavesNoSeam) {
    Mesh mesh = made_up_scan({.faces = 20000, .relief = 0.1, .noise = 0});
    mesh.normals = continuous_normals(mesh, NormalMode::angle);
    const std::vector<Vec3f> combs = combed(mesh, 0, 3);
    EXPECT_EQ(combs, combed(mesh, 0, 1));
    std::size_t strong = 0;
    for (std::size_t v = 0; v < combs.size(); ++v) {
        EXPECT_LT(std::abs(dot(combs[v], mesh.normals[v])), 1e-5);
        EXPECT_LT(length(combs[v]), 1 + 1e-5);
        strong += length(combs[v]) > 0.99f;
    }
    EXPECT_GT(strong, combs.size() * 3 / 4);
    // Across every edge the comb turns no faster than the normal does.
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1];
        EXPECT_LT(length(combs[a] - combs[b]), 4.5 * length(mesh.normals[a] - mesh.normals[b]) + 1e-4);
    }
}

TEST(Comb, LeansIntoNoFace) {
    Mesh mesh;
    mesh.positions = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    mesh.indices = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
    mesh.normals = continuous_normals(mesh, NormalMode::angle);
    const float lean = 1.1f;
    const std::vector<Vec3f> combs = combed(mesh, lean), free = combed(mesh, 0);
    bool would_have = false;
    for (std::uint32_t f = 0; f < 4; ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = mesh.indices[f * 3 + k];
            const auto above = [&](Vec3f comb) {
                const double l = length(comb), a = lean * l;
                const Vec3d n(mesh.normals[v]);
                return dot(l > 0 ? n * std::cos(a) + Vec3d(comb) * (std::sin(a) / l) : n, normalize(face_vector(mesh, f)));
            };
            EXPECT_GT(above(combs[v]), 0.08) << f << ' ' << k;
            would_have |= above(free[v]) < 0;
        }
    EXPECT_TRUE(would_have);
}

TEST(LockNoise, RepeatsAndIsSmooth) {
    const LockNoise noise = lock_noise();
    double largest = 0, steepest = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3d p(0.37 * i, 0.11 * i, 0.73 * i);
        const Vec3d v = lock_noise_at(noise, p);
        EXPECT_LT(length(v - lock_noise_at(noise, p + Vec3d(1, -2, 5))), 1e-9);
        largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
        steepest = std::max(steepest, length(lock_noise_at(noise, p + Vec3d(1e-3, 0, 0)) - v) / 1e-3);
    }
    EXPECT_LE(largest, 1);
    EXPECT_GT(largest, 0.7);
    EXPECT_LT(steepest, 2 * 2.2 * LockNoise::hills);  // two values apart in one hill, at most 15/8 times as steep, and two more axes
}

TEST(Coats, AreInTheRangesTheirKnobsAllow) {
    std::set<std::string_view> ids;
    for (const CoatPreset& p : coat_presets()) {
        EXPECT_TRUE(ids.insert(p.id).second) << p.id;
        for (const CoatKnob& k : coat_knobs()) {
            EXPECT_GE(p.coat.*k.member, k.least) << p.id << ' ' << k.id;
            EXPECT_LE(p.coat.*k.member, k.most) << p.id << ' ' << k.id;
        }
    }
}

}  // namespace
}  // namespace relievo
