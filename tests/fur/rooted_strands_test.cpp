// Strands as programs receive them: every root once, its normal, comb and length as the mesh has them.
#include "fur/rooted_strands.h"

#include "fur/strand_grid.h"
#include "mesh/made_up_scan.h"
#include "mesh/normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace relievo {
namespace {

// What shaders/hosts/strands/family.glsl does, in double.
Vec3d unpacked_normal(std::uint32_t bits) {
    const auto part = [](std::uint32_t b) { return static_cast<double>(static_cast<std::int16_t>(b & 0xffffu)) / 32767; };
    Vec3d n(part(bits), part(bits >> 16), 0);
    n.z = 1 - std::abs(n.x) - std::abs(n.y);
    const double t = std::max(-n.z, 0.0);
    n.x += n.x >= 0 ? -t : t;
    n.y += n.y >= 0 ? -t : t;
    return normalize(n);
}
Vec3d unpacked_comb(std::uint32_t bits) {
    const auto part = [](std::uint32_t b) { return (b & 1023u) * 2.0 / 1023 - 1; };
    return {part(bits), part(bits >> 10), part(bits >> 20)};
}

struct Ball {
    Mesh mesh = made_up_scan({.faces = 3000, .relief = 0, .noise = 0});
    Roots roots;
    std::vector<Vec3f> comb;
    std::vector<float> lengths;
    Ball() {
        mesh.normals = continuous_normals(mesh, NormalMode::angle);
        roots = grow_roots(mesh, {.count = 5000});
        for (const Vec3f& p : mesh.positions) {
            comb.push_back({p.y * 0.5f, -p.x * 0.5f, 0});
            lengths.push_back(std::clamp(0.5f + 0.4f * p.z, 0.0f, 1.0f));
        }
    }
};

TEST(RootedStrands, KeepEveryRootWithItsNormalCombAndLength) {
    const Ball ball;
    const RootedStrands strands = rooted_strands(ball.mesh, ball.comb, ball.lengths, ball.roots);
    ASSERT_EQ(strands.places.size(), ball.roots.roots.size());
    ASSERT_EQ(strands.natures.size(), ball.roots.roots.size());
    std::vector<std::array<float, 3>> wanted, got;
    for (const Root& r : ball.roots.roots) wanted.push_back({r.position.x, r.position.y, r.position.z});
    for (std::size_t i = 0; i < strands.places.size(); ++i) {
        const Vec3d root(strands.places[i].root), outward = normalize(root);
        got.push_back({strands.places[i].root.x, strands.places[i].root.y, strands.places[i].root.z});
        EXPECT_GT(dot(unpacked_normal(strands.natures[i].normal), outward), 0.998);  // the mesh's normals are within three degrees of the ball's
        const Vec3d comb = unpacked_comb(strands.places[i].comb) - Vec3d(root.y * 0.5, -root.x * 0.5, 0);
        EXPECT_LT(length(comb), 0.003);  // half a step of 2 / 1023 along each axis
        EXPECT_NEAR((strands.natures[i].own >> 16) / 65535.0, std::clamp(0.5 + 0.4 * root.z, 0.0, 1.0), 1e-3);
        EXPECT_EQ(strands.natures[i].own & 0xffffu, strand_chance(strands.places[i].root));
    }
    std::ranges::sort(wanted);
    std::ranges::sort(got);
    EXPECT_EQ(wanted, got);
}

TEST(RootedStrands, StandInTheOrderOfTheirRootsAndAreOfFullLengthByThemselves) {
    const Ball ball;
    const RootedStrands strands = rooted_strands(ball.mesh, ball.comb, {}, ball.roots);
    for (std::size_t i = 0; i < strands.places.size(); ++i) EXPECT_EQ(strands.places[i].root, ball.roots.roots[i].position);
    for (const RootedStrands::Nature& n : strands.natures) EXPECT_EQ(n.own >> 16, 65535u);
}

TEST(RootedStrands, DoNotDependOnThreads) {
    const Ball ball;
    const RootedStrands one = rooted_strands(ball.mesh, ball.comb, ball.lengths, ball.roots, 1), three = rooted_strands(ball.mesh, ball.comb, ball.lengths, ball.roots, 3);
    EXPECT_EQ(std::memcmp(one.places.data(), three.places.data(), one.places.size() * sizeof one.places[0]), 0);
    EXPECT_EQ(std::memcmp(one.natures.data(), three.natures.data(), one.natures.size() * sizeof one.natures[0]), 0);
}

}  // namespace
}  // namespace relievo
