// The measure of even fur on layouts whose answer is known.
#include "fur/evenness.h"

#include "mesh/made_up_scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace relievo {
namespace {

TEST(AreaInBall, IsThatOfSectorsAndTriangles) {
    const Vec3d a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
    constexpr double pi = std::numbers::pi;
    EXPECT_NEAR(area_in_ball(a, b, c, {0, 0, 0}, 0.5), pi * 0.25 / 4, 1e-12);                 // a quarter of a disc
    EXPECT_NEAR(area_in_ball(a, c, b, {0, 0, 0}, 0.5), pi * 0.25 / 4, 1e-12);                 // seen from behind
    EXPECT_NEAR(area_in_ball(a, b, c, {0.5, 0, 0}, 0.2), pi * 0.04 / 2, 1e-12);               // half a disc on an edge
    EXPECT_NEAR(area_in_ball(a, b, c, {0.25, 0.25, 0.3}, 0.35), pi * (0.1225 - 0.09), 1e-12); // a whole one, of a ball above
    EXPECT_NEAR(area_in_ball(a, b, c, {0.3, 0.3, 0}, 5), 0.5, 1e-12);                         // the whole triangle
    EXPECT_EQ(area_in_ball(a, b, c, {0.3, 0.3, 1}, 0.9), 0);
    EXPECT_EQ(area_in_ball(a, b, c, {-1, -1, 0}, 0.9), 0);
    EXPECT_EQ(area_in_ball(a, b, b, {0, 0, 0}, 1), 0);
}

// A square of edge 1 and roots in its plane.
struct Layout {
    Mesh mesh;
    Roots roots;
};
Layout square() {
    Layout l;
    l.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    l.mesh.indices = {0, 1, 2, 0, 2, 3};
    l.roots.area = 1;
    return l;
}

TEST(Evenness, OfALatticeIsNearOneAndOfAStepItsRatio) {
    Layout l = square();
    constexpr int n = 120;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) l.roots.roots.push_back({{(static_cast<float>(x) + 0.5f) / n, (static_cast<float>(y) + 0.5f) / n, 0}, 0});
    const Evenness lattice = evenness(l.mesh, l.roots, {}, {.extent = 0.7});
    EXPECT_NEAR(lattice.p50, 1, 0.03);
    EXPECT_LT(lattice.density_p95_over_p5, 1.15);
    EXPECT_EQ(lattice.shared_texel_area, 0);

    // Every fourth row only on the right half: 4 times as dense on the left.
    std::erase_if(l.roots.roots, [](const Root& r) { return r.position.x > 0.5f && static_cast<int>(r.position.y * n) % 4 != 0; });
    EXPECT_NEAR(evenness(l.mesh, l.roots, {}, {.extent = 0.7}).density_p95_over_p5, 4, 0.9);
    // Nothing on the right half.
    std::erase_if(l.roots.roots, [](const Root& r) { return r.position.x > 0.5f; });
    EXPECT_EQ(evenness(l.mesh, l.roots, {}, {.extent = 0.7}).density_p95_over_p5, std::numeric_limits<double>::infinity());
}

TEST(Evenness, OfRandomRootsIsWorseThanOfGrownOnes) {
    const Mesh mesh = made_up_scan({.faces = 20000});
    const Roots grown = grow_roots(mesh, {.count = 20000});
    EXPECT_LT(evenness(mesh, grown, {}, {.extent = 1.3}).density_p95_over_p5, 1.3);
    Layout l = square();
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int i = 0; i < 20000; ++i) l.roots.roots.push_back({{unit(random), unit(random), 0}, 0});
    // Counts of mean 64 spread by 8: 1.645 of that to either side are 1.52 times apart.
    EXPECT_NEAR(evenness(l.mesh, l.roots, {}, {.extent = 0.7}).density_p95_over_p5, 1.52, 0.1);
}

TEST(Evenness, SeesStrandsSharedWithDistantPlacesOnly) {
    Layout l = square();
    std::vector<std::uint32_t> strands;
    constexpr int n = 60;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            l.roots.roots.push_back({{(static_cast<float>(x) + 0.5f) / n, (static_cast<float>(y) + 0.5f) / n, 0}, 0});
            // The lower quarter repeats to the right; elsewhere pairs of neighbours share a strand.
            const int own = y < n / 4 ? x % (n / 2) : x / 2 + n;
            strands.push_back(static_cast<std::uint32_t>(own + y * 4 * n));
        }
    EXPECT_NEAR(evenness(l.mesh, l.roots, strands, {.extent = 0.7}).shared_texel_area, 0.25, 0.02);
}

TEST(Evenness, DoesNotDependOnThreads) {
    const Mesh mesh = made_up_scan({.faces = 40000});
    const Roots roots = grow_roots(mesh, {.count = 40000});
    const Evenness one = evenness(mesh, roots, {}, {.extent = 1.3, .threads = 1}), three = evenness(mesh, roots, {}, {.extent = 1.3, .threads = 3});
    EXPECT_EQ(one.p5, three.p5);
    EXPECT_EQ(one.p95, three.p95);
    EXPECT_GT(one.p95, one.p5);
}

}  // namespace
}  // namespace relievo
