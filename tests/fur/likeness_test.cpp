// Copies among strands: none in fur that grows by itself, all in fur that is made to repeat.
#include "fur/likeness.h"

#include "fur/evenness.h"
#include "fur/strand_grid.h"
#include "mesh/made_up_scan.h"

#include <gtest/gtest.h>

#include <set>

namespace relievo {
namespace {

std::vector<std::uint32_t> chances_of(const Roots& roots) {
    std::vector<std::uint32_t> chances;
    for (const Root& r : roots.roots) chances.push_back(strand_chance(r.position));
    return chances;
}

double shared(const Mesh& mesh, const Roots& roots, const std::vector<std::uint32_t>& chances) {
    const std::vector<std::uint32_t> alike = likeness(roots, chances);
    return evenness(mesh, roots, alike, {.extent = 1}).shared_texel_area;
}

TEST(Likeness, EveryStrandIsItsOwn) {
    const Mesh mesh = made_up_scan({.faces = 5000});
    const Roots roots = grow_roots(mesh, {.count = 70000});
    const std::vector<std::uint32_t> chances = chances_of(roots), alike = likeness(roots, chances);
    // Of so many strands most share their chance with another; with their neighbours none does.
    EXPECT_LE(std::set(chances.begin(), chances.end()).size(), 65536u);
    EXPECT_EQ(std::set(alike.begin(), alike.end()).size(), roots.roots.size());
    EXPECT_EQ(shared(mesh, roots, chances), 0);
    EXPECT_EQ(likeness(roots, chances, 1), likeness(roots, chances, 3));
}

TEST(Likeness, SymmetricPartsDoNotRepeat) {
    // A machine part: two squares half a turn apart around y, with the same roots.
    Mesh mesh;
    mesh.positions = {{1, 0, 1}, {1, 0, 2}, {2, 0, 2}, {2, 0, 1}, {-1, 0, -1}, {-1, 0, -2}, {-2, 0, -2}, {-2, 0, -1}};
    mesh.indices = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    Mesh first = mesh;
    first.indices.resize(6);
    Roots roots = grow_roots(first, {.count = 4000});
    for (std::size_t i = 0, half = roots.roots.size(); i < half; ++i) {
        const Root r = roots.roots[i];
        roots.roots.push_back({{-r.position.x, r.position.y, -r.position.z}, r.face + 2});
    }
    roots.area *= 2;
    EXPECT_EQ(shared(mesh, roots, chances_of(roots)), 0);
}

TEST(Likeness, FurThatRepeatsItselfIsFound) {
    // Two squares far apart, the second with the roots of the first, moved: a texture laid on twice.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {4, 0, 0}, {4, 0, 1}, {5, 0, 1}, {5, 0, 0}};
    mesh.indices = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    Mesh first = mesh;
    first.indices.resize(6);
    Roots roots = grow_roots(first, {.count = 4000});
    const std::size_t half = roots.roots.size();
    for (std::size_t i = 0; i < half; ++i) roots.roots.push_back({roots.roots[i].position + Vec3f(4, 0, 0), roots.roots[i].face + 2});
    roots.area *= 2;
    const std::vector<std::uint32_t> own = chances_of(roots);
    EXPECT_EQ(shared(mesh, roots, own), 0);
    std::vector<std::uint32_t> copied(own);
    std::copy_n(own.begin(), half, copied.begin() + static_cast<std::ptrdiff_t>(half));
    EXPECT_GT(shared(mesh, roots, copied), 0.98);  // but for neighbours at equal distances within rounding
    // Chances that repeat without their neighbours' doing so are no copies.
    for (std::size_t i = 0; i < copied.size(); ++i) copied[i] = own[i] & 0xffu;
    EXPECT_LT(shared(mesh, roots, copied), 0.01);
    std::fill(copied.begin(), copied.end(), 7u);
    EXPECT_EQ(shared(mesh, roots, copied), 1);
}

}  // namespace
}  // namespace relievo
