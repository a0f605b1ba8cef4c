// Where fur grows how long: each quantity where its value is known, rules together, and what is said of wrong ones.
#include "fur/length_rules.h"

#include "core/error.h"
#include "fur/comb.h"
#include "fur/strand_curves.h"
#include "mesh/made_up_scan.h"
#include "mesh/normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace relievo {
namespace {

// Radius 0.5: curvature 2.
struct Ball {
    Mesh mesh = made_up_scan({.faces = 8000, .relief = 0, .noise = 0});
    Ball() {
        for (Vec3f& p : mesh.positions) p *= 0.5f;
        mesh.normals = continuous_normals(mesh, NormalMode::angle);
    }
    std::vector<float> shares(const std::vector<std::string>& rules, const std::shared_ptr<const ImageF>& mask = {}, const Sphere& sphere = {{}, 1}) const {
        std::vector<LengthRule> all;
        for (const std::string& r : rules) {
            all.push_back(length_rule(r));
            all.back().mask = mask;
        }
        return length_shares(mesh, sphere, all);
    }
};

double smooth(double t) {
    t = std::clamp(t, 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

TEST(LengthRules, KnownQuantitiesOnABall) {
    const Ball ball;
    const std::vector<float> height = ball.shares({"height"}), up = ball.shares({"up=-1..1"}), down = ball.shares({"up=1..-1"});
    const std::vector<float> near = ball.shares({"distance=0..4@10,1,0"}, {}, {{10, 0, 0}, 2});  // in fur space: (0, 0.5, 0)
    for (std::size_t v = 0; v < ball.mesh.positions.size(); ++v) {
        const Vec3d p(ball.mesh.positions[v]);
        ASSERT_NEAR(height[v], smooth(p.y + 0.5), 2e-3);
        ASSERT_NEAR(up[v], smooth((ball.mesh.normals[v].y + 1) / 2), 1e-6);
        ASSERT_NEAR(up[v] + down[v], 1, 1e-6);
        ASSERT_NEAR(near[v], smooth(length(p - Vec3d(0, 0.5, 0)) / 4), 1e-6);
    }
}

TEST(LengthRules, CurvatureIsThatOfTheSphere) {
    // With the sphere's own normals every edge tells 2 exactly; faceted ones are off by the facets.
    Ball ball;
    for (std::size_t v = 0; v < ball.mesh.normals.size(); ++v) ball.mesh.normals[v] = ball.mesh.positions[v] * 2.0f;
    for (const float c : mean_curvature(ball.mesh)) ASSERT_NEAR(c, 2, 1e-3);
    // From inside a hollow is the same surface turned round.
    for (Vec3f& n : ball.mesh.normals) n = -n;
    for (const float c : mean_curvature(ball.mesh)) ASSERT_NEAR(c, -2, 1e-3);
}

TEST(LengthRules, ColoursAndMasks) {
    Ball ball;
    EXPECT_THROW(ball.shares({"red"}), Error);
    for (const Vec3f& p : ball.mesh.positions) ball.mesh.colours.push_back({p.x + 0.5f, p.x + 0.5f, p.x > 0 ? 1.0f : 0.0f});
    const std::vector<float> red = ball.shares({"red"}), blue = ball.shares({"blue=1..0"});
    // A picture of two texels, dark on the left: along x it rises from a quarter of the width to three quarters.
    auto mask = std::make_shared<ImageF>(2, 1, 1);
    (*mask)(1, 0) = 1;
    const std::vector<float> thrown = ball.shares({"mask@picture.png"}, mask);
    ball.mesh.uvs.assign(ball.mesh.positions.size(), Vec2f(0.75f, 0.5f));
    const std::vector<float> laid = ball.shares({"mask@picture.png"}, mask);
    for (std::size_t v = 0; v < red.size(); ++v) {
        const double x = ball.mesh.positions[v].x;
        ASSERT_NEAR(red[v], smooth(x + 0.5), 1e-6);
        ASSERT_EQ(blue[v], x > 0 ? 0.0f : 1.0f);
        ASSERT_NEAR(thrown[v], smooth(2 * x + 0.5), 1e-2);
        ASSERT_NEAR(laid[v], 1, 1e-6);
    }
}

TEST(LengthRules, MultiplyAndDoNotDependOnThreads) {
    const Ball ball;
    const std::vector<float> a = ball.shares({"height=0.2..0.8"}), b = ball.shares({"noise@0.3"}), both = ball.shares({"height=0.2..0.8", "noise@0.3"});
    float least = 1, most = 0;
    for (std::size_t v = 0; v < a.size(); ++v) {
        ASSERT_NEAR(both[v], a[v] * b[v], 1e-6);
        least = std::min(least, b[v]);
        most = std::max(most, b[v]);
    }
    EXPECT_LT(least, 0.2f);
    EXPECT_GT(most, 0.8f);
    const std::vector<LengthRule> rules{length_rule("curvature=0..4"), length_rule("noise")};
    EXPECT_EQ(length_shares(ball.mesh, {{}, 1}, rules, 1), length_shares(ball.mesh, {{}, 1}, rules, 3));
    EXPECT_TRUE(length_shares(ball.mesh, {{}, 1}, {}).empty());
}

TEST(LengthRules, StrandsAreAsLongAsTheirShare) {
    const Ball ball;
    const std::vector<float> shares = ball.shares({"height"});
    const Roots roots = grow_roots(ball.mesh, {.count = 400});
    const Coat coat{.length = 0.2f, .tilt = 0.4f, .bend = 0.5f, .spread = 0, .length_variation = 0, .lock = 0, .guard_hairs = 0};
    const StrandCurves c = strand_curves(ball.mesh, combed(ball.mesh, 0), roots, coat, 0.1, 32, 0, {.lengths = shares});
    for (std::size_t s = 0; s < roots.roots.size(); ++s) {
        double way = 0;
        for (std::size_t k = 0; k < 32; ++k) way += length(Vec3d(c.points[s * 33 + k + 1]) - Vec3d(c.points[s * 33 + k]));
        // The share is interpolated over the face.
        ASSERT_NEAR(way, 0.2 * smooth(static_cast<double>(roots.roots[s].position.y) + 0.5), 2e-3);
    }
}

TEST(LengthRules, SaysWhatIsWrong) {
    for (const char* bad : {"", "hight", "up=1", "up=a..b", "up=0..", "up=0..1@2", "distance", "distance@1,2", "distance@1,2,3,4", "noise@0", "noise@-1", "mask", "mask=0..1", "up=0..inf", "up=nan..1"})
        EXPECT_THROW(length_rule(bad), UsageError) << bad;
    try {
        length_rule("hight=0..1");
        FAIL();
    } catch (const UsageError& e) {
        EXPECT_NE(std::string(e.what()).find("height"), std::string::npos) << e.what();
    }
    const LengthRule r = length_rule("distance=0.5..0.25@-1,2.5,1e3");
    EXPECT_EQ(r.place, Vec3d(-1, 2.5, 1000));
    EXPECT_EQ(r.from, 0.5);
    EXPECT_EQ(r.to, 0.25);
    EXPECT_EQ(length_rule("mask@a=b..c@d.png").file, "a=b..c@d.png");
}

}  // namespace
}  // namespace relievo
