#include "assets/triangulate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace relievo {
namespace {

double area_of(Vec3f a, Vec3f b, Vec3f c) { return length(cross(Vec3d(b) - Vec3d(a), Vec3d(c) - Vec3d(a))) / 2; }

// Area by the shoelace formula: what any cut has to add up to, and only a cut without overlaps does with unsigned areas.
double shoelace(const std::vector<Vec3f>& p) {
    Vec3d sum(0.0);
    for (std::size_t i = 0; i < p.size(); ++i) sum += cross(Vec3d(p[i]), Vec3d(p[(i + 1) % p.size()]));
    return length(sum) / 2;
}

double covered(const std::vector<Vec3f>& polygon, const std::vector<std::uint32_t>& triangles) {
    double sum = 0;
    for (std::size_t i = 0; i < triangles.size(); i += 3) sum += area_of(polygon[triangles[i]], polygon[triangles[i + 1]], polygon[triangles[i + 2]]);
    return sum;
}

// A star-shaped outline with n corners, radii between 0.2 and 1, in a plane that leans.
std::vector<Vec3f> star(std::size_t n, std::mt19937& random) {
    std::uniform_real_distribution<double> radius(0.2, 1.0);
    std::vector<Vec3f> polygon;
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n), r = radius(random);
        polygon.emplace_back(static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle)), static_cast<float>(0.5 * r * std::cos(angle) - 0.3 * r * std::sin(angle)));
    }
    return polygon;
}

TEST(Triangulate, a_convex_polygon_becomes_a_fan) {
    std::vector<std::uint32_t> triangles;
    EXPECT_TRUE(triangulate(std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, triangles));
    EXPECT_EQ(triangles, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST(Triangulate, a_dart_is_cut_along_its_short_diagonal_whatever_corner_comes_first) {
    const std::vector<Vec3f> dart = {{0, 0, 0}, {2, -1, 0}, {1, 0, 0}, {2, 1, 0}};  // turns inwards at (1,0,0)
    for (std::size_t first = 0; first < 4; ++first)
        for (const bool backwards : {false, true}) {
            std::vector<Vec3f> polygon;
            for (std::size_t k = 0; k < 4; ++k) polygon.push_back(dart[(first + (backwards ? 4 - k : k)) % 4]);
            std::vector<std::uint32_t> triangles;
            EXPECT_TRUE(triangulate(polygon, triangles));
            EXPECT_NEAR(covered(polygon, triangles), 1.0, 1e-6);
        }
}

TEST(Triangulate, random_outlines_are_covered_once_and_keep_their_orientation) {
    std::mt19937 random(5);
    for (const std::size_t n : {4u, 5u, 8u, 17u, 64u, 300u, 3000u})
        for (int trial = 0; trial < (n > 100 ? 2 : 20); ++trial) {
            const std::vector<Vec3f> polygon = star(n, random);
            std::vector<std::uint32_t> triangles;
            EXPECT_TRUE(triangulate(polygon, triangles)) << n;
            ASSERT_EQ(triangles.size(), 3 * (n - 2));
            EXPECT_NEAR(covered(polygon, triangles), shoelace(polygon), 1e-5 * shoelace(polygon)) << n;
            // All triangles face the way the outline does.
            const Vec3d facing(-0.5, 0.3, 1.0);
            for (std::size_t i = 0; i < triangles.size(); i += 3) {
                const Vec3d a(polygon[triangles[i]]), b(polygon[triangles[i + 1]]), c(polygon[triangles[i + 2]]);
                EXPECT_GT(dot(cross(b - a, c - a), facing), -1e-7);
            }
        }
}

TEST(Triangulate, a_comb_has_every_tooth) {
    // Long thin teeth: nearly every triangle that comes to mind first is wrong.
    std::vector<Vec3f> comb;
    constexpr int teeth = 50;
    for (int i = 0; i < teeth; ++i) {
        comb.emplace_back(static_cast<float>(2 * i), 0.0f, 100.0f);
        comb.emplace_back(static_cast<float>(2 * i + 1), 0.0f, 1.0f);
    }
    comb.emplace_back(2.0f * teeth, 0.0f, 100.0f);
    comb.emplace_back(2.0f * teeth, 0.0f, 0.0f);
    comb.emplace_back(0.0f, 0.0f, 0.0f);
    std::vector<std::uint32_t> triangles;
    EXPECT_TRUE(triangulate(comb, triangles));
    EXPECT_NEAR(covered(comb, triangles), shoelace(comb), 1e-6 * shoelace(comb));
}

TEST(Triangulate, outlines_that_cannot_be_cut_cleanly_say_so_and_still_end) {
    std::vector<std::uint32_t> triangles;
    EXPECT_FALSE(triangulate(std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1.5f, 0, 0}}, triangles));  // no area
    EXPECT_EQ(triangles.size(), 9u);
    triangles.clear();
    EXPECT_FALSE(triangulate(std::vector<Vec3f>(1000, Vec3f(1.0f)), triangles));
    EXPECT_EQ(triangles.size(), 3u * 998);
    // Corners strewn at random cross themselves everywhere.
    std::mt19937 random(6);
    std::uniform_real_distribution<float> place(-1, 1);
    std::vector<Vec3f> tangle(2000);
    for (Vec3f& p : tangle) p = {place(random), place(random), place(random)};
    triangles.clear();
    triangulate(tangle, triangles);
    EXPECT_EQ(triangles.size(), 3u * 1998);
}

}  // namespace
}  // namespace relievo
