// Strands as curves, where their shape is known.
#include "fur/strand_curves.h"

#include "fur/comb.h"
#include "fur/facing.h"
#include "fur/refined.h"
#include "mesh/made_up_scan.h"
#include "mesh/normals.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relievo {
namespace {

struct Ball {
    Mesh mesh = made_up_scan({.faces = 3000, .relief = 0, .noise = 0});
    std::vector<Vec3f> comb;
    Roots roots;
    Ball() {
        mesh.normals = continuous_normals(mesh, NormalMode::angle);
        comb = combed(mesh, 0);
        roots = grow_roots(mesh, {.count = 500});
    }
    StrandCurves curves(const Coat& coat, int pieces = 8, int threads = 0) const { return strand_curves(mesh, comb, roots, coat, 0.1, pieces, threads); }
};

TEST(StrandCurves, StandUprightWhereNothingBendsThem) {
    const Ball ball;
    const Coat coat{.length = 0.2f, .tilt = 0, .bend = 0, .spread = 0, .width = 0.5f, .length_variation = 0.5f, .lock = 0, .guard_hairs = 0};
    const StrandCurves c = ball.curves(coat);
    ASSERT_EQ(c.strands.size(), ball.roots.roots.size());
    float shortest = 1, longest = 0;
    for (std::size_t s = 0; s < c.strands.size(); ++s) {
        const Vec3f root = ball.roots.roots[s].position;
        EXPECT_LT(length(c.points[s * 9] - root), 1e-6);
        // The least bend, which keeps the formula from dividing by zero, moves the tip by 0.0005 of the length.
        EXPECT_LT(length(c.points[s * 9 + 8] - (root + c.strands[s].normal * (0.2f * c.strands[s].tip))), 1.1e-4);
        EXPECT_NEAR(c.radii[s * 9], 0.05, 1e-6);
        EXPECT_NEAR(c.radii[s * 9 + 8], 0, 1e-6);
        shortest = std::min(shortest, c.strands[s].tip);
        longest = std::max(longest, c.strands[s].tip);
    }
    EXPECT_NEAR(shortest, 0.5, 0.02);
    EXPECT_NEAR(longest, 1, 0.02);
}

TEST(StrandCurves, KeepTheirLengthWhenTheyBend) {
    const Ball ball;
    for (const float bend : {0.0f, 0.6f, 1.2f}) {
        const Coat coat{.length = 0.3f, .tilt = 0.3f, .bend = bend, .spread = 0, .length_variation = 0, .lock = 0, .guard_hairs = 0};
        const StrandCurves c = ball.curves(coat, 64);
        for (std::size_t s = 0; s < c.strands.size(); ++s) {
            double way = 0;
            for (std::size_t k = 0; k < 64; ++k) way += length(Vec3d(c.points[s * 65 + k + 1]) - Vec3d(c.points[s * 65 + k]));
            ASSERT_NEAR(way, 0.3, 0.001);
        }
    }
}

TEST(StrandCurves, CurlsHaveTheirRadiusAndThreadsChangeNothing) {
    const Ball ball;
    const Coat coat{.length = 0.3f, .tilt = 0, .bend = 0, .spread = 0, .length_variation = 0, .lock = 0, .curl_radius = 0.4f, .curl_turns = 2, .guard_hairs = 0};
    const StrandCurves c = ball.curves(coat, 16);
    for (std::size_t s = 0; s < c.strands.size(); ++s) {
        const Vec3d root(ball.roots.roots[s].position), n(c.strands[s].normal), off = Vec3d(c.points[s * 17 + 11]) - root;
        ASSERT_NEAR(length(off - n * dot(off, n)), 0.04, 1e-4);
    }
    Coat rabbit;
    const StrandCurves one = ball.curves(rabbit, 8, 1), many = ball.curves(rabbit, 8, 5);
    EXPECT_EQ(one.points, many.points);
    EXPECT_EQ(one.radii, many.radii);
}

TEST(Refined, KeepsTheSurfaceAndWhatIsShared) {
    Mesh tetrahedron;
    tetrahedron.positions = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
    tetrahedron.indices = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
    tetrahedron.normals = continuous_normals(tetrahedron, NormalMode::angle);
    const Mesh fine = refined(tetrahedron, 300);
    EXPECT_EQ(fine.faces(), 256u);            // 4 * 4^3, as four times that would be too many
    EXPECT_EQ(fine.positions.size(), 130u);   // closed: vertices = faces / 2 + 2
    double area_before = 0, area_after = 0;
    for (std::uint32_t f = 0; f < 4; ++f) area_before += length(face_vector(tetrahedron, f));
    for (std::uint32_t f = 0; f < 256; ++f) area_after += length(face_vector(fine, f));
    EXPECT_NEAR(area_after, area_before, 1e-5);
    for (const Vec3f& n : fine.normals) EXPECT_NEAR(length(n), 1, 1e-5);
    EXPECT_EQ(refined(fine, 300).positions.size(), 130u);
}

}  // namespace
}  // namespace relievo
