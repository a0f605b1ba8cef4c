// The two generated meshes of the comparison: closed, oriented outwards, of the published size.
#include "pipeline/replicate_fur.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

namespace relievo {
namespace {

double volume_of(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        sum += dot(Vec3d(mesh.positions[mesh.indices[i]]), cross(Vec3d(mesh.positions[mesh.indices[i + 1]]), Vec3d(mesh.positions[mesh.indices[i + 2]]))) / 6;
    return sum;
}

void expect_closed(const Mesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) ++edges[{mesh.indices[i + k], mesh.indices[i + (k + 1) % 3]}];
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_TRUE(edges.contains({edge.second, edge.first}));
    }
}

TEST(ReplicateFur, CubeAndTorusAreThoseOfTheThesis) {
    const Mesh cube = cube_mesh();
    EXPECT_EQ(cube.faces(), 12u);
    expect_closed(cube);
    EXPECT_NEAR(volume_of(cube), 8, 1e-6);
    const Mesh torus = torus_mesh(24, 8);
    EXPECT_EQ(torus.faces(), 384u);
    expect_closed(torus);
    // 2 pi^2 R r^2 of the round one; the faces of fine ones come near it.
    EXPECT_NEAR(volume_of(torus_mesh(200, 100)), 2 * 9.8696 * 0.16, 0.005);
    for (const PublishedFur& p : published_fur()) {
        if (p.mesh == "cube") { EXPECT_EQ(p.faces, cube.faces()); }
        if (p.mesh == "torus") { EXPECT_EQ(p.faces, torus.faces()); }
    }
}

}  // namespace
}  // namespace relievo
