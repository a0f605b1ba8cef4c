#include "mesh/bounds.h"

#include "mesh/shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

namespace relievo {
namespace {

using test::cube;

TEST(Bounds, BoxIsTight) {
    const std::vector<Vec3f> p{{1, -2, 3}, {-4, 5, 0}, {2, 2, -7}};
    const Box box = bounding_box(p);
    EXPECT_EQ(box.low, Vec3f(-4, -2, -7));
    EXPECT_EQ(box.high, Vec3f(2, 5, 3));
    EXPECT_EQ(bounding_box({}).low, Vec3f());
}

TEST(Bounds, SpheresKnownByHeart) {
    const auto radius = [](const std::vector<Vec3f>& p) { return bounding_sphere(p).radius; };
    EXPECT_EQ(radius({}), 0);
    EXPECT_EQ(radius({{3, 4, 5}}), 0);
    EXPECT_NEAR(radius({{0, 0, 0}, {2, 0, 0}}), 1, 1e-12);
    EXPECT_NEAR(radius({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1.5, 0, 0}}), 1, 1e-12);  // on a line
    EXPECT_NEAR(radius({{0, 0, 0}, {10, 0, 0}, {5, 1, 0}}), 5, 1e-12);              // obtuse: the longest side decides
    EXPECT_NEAR(radius({{1, 0, 0}, {-0.5f, 0.8660254f, 0}, {-0.5f, -0.8660254f, 0}}), 1, 1e-7);
    EXPECT_NEAR(radius(test::tetrahedron().positions), std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(radius(cube().positions), std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(radius(test::sphere(4).positions), 1, 1e-7);  // all points on it but for rounding
    EXPECT_NEAR(radius(test::torus(64, 32).positions), 1.4, 1e-6);
    // Half the diagonal of the box is 1.73 here.
    EXPECT_NEAR(radius({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}), 1, 1e-12);
}

// The sphere through the points of a subset with its centre in their affine hull, by barycentric coordinates from Cramer's rule:
// another way than the code under test takes.
std::optional<Sphere> circumscribed(const std::vector<Vec3d>& q) {
    if (q.size() == 1) return Sphere{q[0], 0};
    if (q.size() == 2) return Sphere{(q[0] + q[1]) * 0.5, length(q[0] - q[1]) / 2};
    if (q.size() == 3) {
        const Vec3d a = q[1] - q[0], b = q[2] - q[0], n = cross(a, b);
        if (dot(n, n) < 1e-18) return std::nullopt;
        const Vec3d o = (cross(n, a) * dot(b, b) + cross(b, n) * dot(a, a)) / (2 * dot(n, n));
        return Sphere{q[0] + o, length(o)};
    }
    const Vec3d a = q[1] - q[0], b = q[2] - q[0], c = q[3] - q[0];
    const double d = 2 * dot(a, cross(b, c));
    if (std::abs(d) < 1e-9) return std::nullopt;
    const Vec3d o = (cross(b, c) * dot(a, a) + cross(c, a) * dot(b, b) + cross(a, b) * dot(c, c)) / d;
    return Sphere{q[0] + o, length(o)};
}

double smallest_by_trying_all(const std::vector<Vec3f>& points) {
    double best = 1e300;
    const std::size_t n = points.size();
    for (unsigned subset = 1; subset < 1u << n; ++subset) {
        std::vector<Vec3d> q;
        for (std::size_t i = 0; i < n; ++i)
            if (subset >> i & 1u) q.emplace_back(points[i]);
        if (q.size() > 4) continue;
        const auto s = circumscribed(q);
        if (!s || s->radius >= best) continue;
        bool all = true;
        for (const Vec3f& p : points) all = all && length(Vec3d(p) - s->centre) <= s->radius * (1 + 1e-9) + 1e-12;
        if (all) best = s->radius;
    }
    return best;
}

TEST(Bounds, SmallestSphereIsTheSmallestOfAllSpheres) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> unit(-1, 1);
    for (int round = 0; round < 300; ++round) {
        std::vector<Vec3f> p(1 + random() % 11);
        // Clouds, plates and needles, on a lattice every third time so that points coincide, line up and lie on one sphere.
        const Vec3f shape(1, round % 3 == 1 ? 0.01f : 1, round % 5 == 1 ? 0.0f : 1);
        for (Vec3f& v : p) {
            v = Vec3f(unit(random), unit(random), unit(random)) * shape;
            if (round % 3 == 0) v = Vec3f(std::round(v.x * 2), std::round(v.y * 2), std::round(v.z * 2));
            v += Vec3f(round % 7 == 0 ? 100.0f : 0.0f);
        }
        const Sphere s = bounding_sphere(p);
        EXPECT_NEAR(s.radius, smallest_by_trying_all(p), 1e-6 * (s.radius + 1e-3)) << "round " << round;
        for (const Vec3f& v : p) EXPECT_LE(length(Vec3d(v) - s.centre), s.radius * (1 + 1e-12));
    }
}

TEST(Bounds, ManyPointsAnyThreads) {
    std::mt19937 random(6);
    std::normal_distribution<float> normal;
    std::vector<Vec3f> p(200000);
    for (Vec3f& v : p) v = {normal(random), 2 * normal(random), normal(random) + 5};
    const Sphere one = bounding_sphere(p, 1), four = bounding_sphere(p, 4);
    EXPECT_EQ(one.radius, four.radius);
    EXPECT_EQ(one.centre, four.centre);
    // No smaller sphere: whichever way the centre moves, one of the points on the sphere gets farther away.
    for (int i = 0; i < 20; ++i) {
        const Vec3d to = one.centre + Vec3d(normal(random), normal(random), normal(random)) * (1e-4 * one.radius);
        double reach = 0;
        for (const Vec3f& v : p) reach = std::max(reach, length(Vec3d(v) - to));
        EXPECT_GT(reach, one.radius);
    }
}

TEST(Bounds, CentredBoxIsAroundTheOrigin) {
    const Mesh mesh = centred(test::moved(cube(), {1000, -3, 0.25f}));
    EXPECT_EQ(bounding_box(mesh.positions).low, Vec3f(-1, -1, -1));
    EXPECT_EQ(bounding_box(mesh.positions).high, Vec3f(1, 1, 1));
}

}  // namespace
}  // namespace relievo
