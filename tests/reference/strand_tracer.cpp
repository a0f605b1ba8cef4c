// Rays against strands whose hits can be said beforehand, and against looking at every piece.
#include "reference/strand_tracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace relievo {
namespace {

// One strand along +y from the origin, thinning from 0.1 to 0, and a skin behind it.
struct OneStrand {
    std::vector<Vec3f> points{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
    std::vector<float> radii{0.1f, 0.05f, 0};
    Mesh skin;
    OneStrand() {
        skin.positions = {{-5, -5, -1}, {5, -5, -1}, {0, 10, -1}};
        skin.indices = {0, 1, 2};
    }
    StrandTracer tracer() const { return StrandTracer({.pieces = 2, .points = points, .radii = radii}, skin); }
};

TEST(StrandTracer, MeetsAStrandWithinItsRadiusAndTheSkinElsewhere) {
    const OneStrand one;
    const StrandTracer tracer = one.tracer();
    const auto at = [&](double x, double y) { return tracer.first_hit({x, y, 3}, {0, 0, -1}); };
    for (const double y : {0.2, 1.0, 1.6}) {
        const double radius = 0.1 * (1 - y / 2);
        for (const double x : {0.0, 0.9 * radius, -0.9 * radius}) {
            const auto hit = at(x, y);
            ASSERT_TRUE(hit && !hit->skin) << x << ' ' << y;
            EXPECT_NEAR(hit->t, 3, 1e-6);
            EXPECT_NEAR(hit->way, y / 2, 1e-6);
            EXPECT_EQ(hit->index, 0u);
        }
        const auto beside = at(1.1 * radius, y);
        ASSERT_TRUE(beside && beside->skin);
        EXPECT_NEAR(beside->t, 4, 1e-6);
    }
    EXPECT_FALSE(at(20, 0));
    EXPECT_FALSE(tracer.first_hit({0, 0.5, 3}, {0, 0, 1}));  // nothing behind the ray's beginning
    const auto face = at(2, -2);
    ASSERT_TRUE(face && face->skin);
    EXPECT_NEAR(-5 + 10 * face->weights.x + 5 * face->weights.y, 2, 1e-5);
}

TEST(StrandTracer, CountsStrandsOnTheWayToTheLight) {
    OneStrand one;
    for (int k = 1; k < 5; ++k)
        for (int i = 0; i < 3; ++i) {
            one.points.emplace_back(0.0f, static_cast<float>(i), static_cast<float>(k));
            one.radii.push_back(0.1f);
        }
    const StrandTracer tracer = one.tracer();
    EXPECT_EQ(tracer.strands_crossed({0, 0.5, -0.5}, {0, 0, 1}, 99, 10), 5);
    EXPECT_EQ(tracer.strands_crossed({0, 0.5, 0}, {0, 0, 1}, 0, 10), 4);  // not its own
    EXPECT_EQ(tracer.strands_crossed({0, 0.5, -0.5}, {0, 0, 1}, 99, 2), 2);
    EXPECT_EQ(tracer.strands_crossed({3, 0.5, 0}, {0, 0, 1}, 99, 10), 0);
    EXPECT_EQ(tracer.strands_crossed({0, 0.5, 9}, {0, 0, -1}, 99, 100), std::nullopt);  // the skin
}

TEST(StrandTracer, FindsWhatASearchWithoutATreeFinds) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<Vec3f> points;
    std::vector<float> radii;
    for (int s = 0; s < 400; ++s) {
        Vec3f p(unit(random), unit(random), unit(random));
        for (int k = 0; k <= 3; ++k) {
            points.push_back(p);
            radii.push_back(0.03f * (1 - static_cast<float>(k) / 3));
            p += Vec3f(unit(random), unit(random), unit(random)) * 0.1f;
        }
    }
    const Mesh none;
    const StrandTracer all({.pieces = 3, .points = points, .radii = radii}, none);
    int hits = 0;
    for (int r = 0; r < 2000; ++r) {
        const Vec3d origin(unit(random) * 2.0, unit(random) * 2.0, 3), target(unit(random), unit(random), unit(random)), ray = normalize(target - origin);
        const auto found = all.first_hit(origin, ray);
        double nearest = 1e9;
        for (std::size_t s = 0; s < 400; ++s) {
            const StrandTracer one({.pieces = 3, .points = std::span(points).subspan(s * 4, 4), .radii = std::span(radii).subspan(s * 4, 4)}, none);
            if (const auto hit = one.first_hit(origin, ray)) nearest = std::min(nearest, hit->t);
        }
        ASSERT_EQ(found.has_value(), nearest < 1e9) << r;
        if (!found) continue;
        ++hits;
        ASSERT_EQ(found->t, nearest) << r;
    }
    EXPECT_GT(hits, 300);
}

}  // namespace
}  // namespace relievo
