#include "measure/hits.h"

#include "core/error.h"
#include "measure/along_ray.h"
#include "frames.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace relievo {
namespace {

using test::plain_frame;
using test::plain_rays;

// The eye stands over -u: the ray travels toward +u.
const Vec3d from_minus_u{-1, 0, 1};

TEST(AlongRay, TravelsAwayFromTheEye) {
    EXPECT_DOUBLE_EQ(texels_along_ray({0.6, 0.5}, {0.5, 0.5}, from_minus_u, {100, 100}), 10);
    EXPECT_DOUBLE_EQ(texels_along_ray({0.4, 0.5}, {0.5, 0.5}, from_minus_u, {100, 100}), -10);
    EXPECT_DOUBLE_EQ(texels_along_ray({0.5, 0.9}, {0.5, 0.5}, from_minus_u, {100, 100}), 0) << "sideways is neither late nor early";
}

TEST(AlongRay, IsMeasuredInTexelsThatNeedNotBeSquare) {
    // Travel along (1,1) in UV is along (2,1) in texels of a 200x100 map; the hit is (20,10) texels farther.
    EXPECT_NEAR(texels_along_ray({0.1, 0.1}, {0, 0}, {-1, -1, 1}, {200, 100}), std::sqrt(500.0), 1e-12);
}

TEST(AlongRay, VerticalRayIsNeitherLateNorEarly) {
    EXPECT_EQ(texels_along_ray({0.7, 0.5}, {0.5, 0.5}, {0, 0, 1}, {100, 100}), 0);
}

TEST(NearestRank, IsTheSmallestValueThatCoversTheShare) {
    std::vector<float> values;
    for (int i = 100; i >= 1; --i) values.push_back(static_cast<float>(i));
    EXPECT_EQ(nearest_rank(values, 0.50), 50);
    EXPECT_EQ(nearest_rank(values, 0.95), 95);
    EXPECT_EQ(nearest_rank(values, 0.99), 99);
    EXPECT_EQ(nearest_rank(values, 1.0), 100);
    std::vector<float> two{7, 3};
    EXPECT_EQ(nearest_rank(two, 0.5), 3);
    EXPECT_EQ(nearest_rank(two, 0.51), 7);
    std::vector<float> one{5};
    EXPECT_EQ(nearest_rank(one, 0.01), 5);
}

TEST(Hits, PerfectPictureHasNoErrors) {
    const Frame f = plain_frame(7, 5);
    const HitMetrics m = hit_metrics(f, f, plain_rays(7, 5, from_minus_u), {64, 64});
    EXPECT_EQ(*m.missed_first_hit, 0);
    EXPECT_EQ(*m.early_hit, 0);
    EXPECT_EQ(m.uv_error_texels->max, 0);
    EXPECT_EQ(m.height_error->max, 0);
    EXPECT_EQ(m.normal_error_deg->max, 0);
    EXPECT_EQ(*m.shadow_mismatch, 0);
    EXPECT_EQ(m.fetches->mean, 4);
}

// Ten pixels with one fault each, so that every number can be said beforehand.
TEST(Hits, EachFaultIsCountedWhereItBelongs) {
    const Frame reference = plain_frame(10, 1);
    const RayField rays = plain_rays(10, 1, from_minus_u);
    Frame p = reference;
    p.hit_uv(0, 0, 0) += 0.6f / 64;   // late by 0.6 texels
    p.hit_uv(1, 0, 0) -= 0.6f / 64;   // early by 0.6
    p.hit_uv(2, 0, 0) += 0.4f / 64;   // right within half a texel
    p.hit_uv(3, 0, 1) += 8.0f / 32;   // sideways by 8 texels of a map that is 32 high
    p.coverage(4, 0) = test::no_hit;  // missed
    p.hit_height(5, 0) = 0.75f;
    p.normal(6, 0, 0) = 1;            // 90 degrees off
    p.normal(6, 0, 2) = 0;
    p.shadow(7, 0) = 0;
    p.shadow(8, 0) = 0.5f;            // differs by half, not by more
    p.fetches(9, 0) = 94;

    const HitMetrics m = hit_metrics(p, reference, rays, {64, 32});
    EXPECT_DOUBLE_EQ(*m.missed_first_hit, 0.2);
    EXPECT_DOUBLE_EQ(*m.early_hit, 0.1);
    EXPECT_NEAR(m.uv_error_texels->max, 8, 1e-5);
    EXPECT_EQ(m.uv_error_texels->p50, 0);
    EXPECT_NEAR(m.uv_error_texels->p99, 8, 1e-5) << "rank ceil(0.99 * 9) = 9 of the 9 pixels with a hit";
    EXPECT_DOUBLE_EQ(m.height_error->max, 0.25);
    EXPECT_DOUBLE_EQ(m.normal_error_deg->max, 90);
    EXPECT_DOUBLE_EQ(*m.shadow_mismatch, 1.0 / 9);
    EXPECT_DOUBLE_EQ(m.fetches->mean, (8 * 4 + 94) / 9.0);
    EXPECT_EQ(m.fetches->p95, 94);
    EXPECT_EQ(m.fetches->max, 94);
}

TEST(Hits, HalfATexelIsStillRight) {
    const Frame reference = plain_frame(2, 1);
    Frame p = reference;
    p.hit_uv(0, 0, 0) += 0.5f / 64;
    p.hit_uv(1, 0, 0) -= 0.5f / 64;
    const HitMetrics m = hit_metrics(p, reference, plain_rays(2, 1, from_minus_u), {64, 64});
    EXPECT_EQ(*m.missed_first_hit, 0);
    EXPECT_EQ(*m.early_hit, 0);
}

TEST(Hits, SmallAnglesKeepTheirDigits) {
    const Frame reference = plain_frame(1, 1);
    Frame p = reference;
    p.normal(0, 0, 0) = 1e-5f;
    const HitMetrics m = hit_metrics(p, reference, plain_rays(1, 1, from_minus_u), {64, 64});
    EXPECT_NEAR(m.normal_error_deg->max, 1e-5 * 180 / 3.14159265358979, 1e-9);
}

TEST(Hits, OnlyPixelsThatBothRaysAndReferenceHitAreJudged) {
    Frame reference = plain_frame(4, 1);
    RayField rays = plain_rays(4, 1, from_minus_u);
    Frame p = reference;
    rays.coverage(0, 0) = test::background;
    reference.coverage(1, 0) = test::no_hit;
    p.hit_uv(0, 0, 0) = p.hit_uv(1, 0, 0) = 9;  // wrong, but nobody asked
    p.hit_uv(2, 0, 0) = 1;
    const HitMetrics m = hit_metrics(p, reference, rays, {64, 64});
    EXPECT_DOUBLE_EQ(*m.missed_first_hit, 0.5);
    EXPECT_NEAR(m.uv_error_texels->max, 32, 1e-5);
}

TEST(Hits, EmptySetsSayWhy) {
    const RayField rays = plain_rays(3, 3, from_minus_u);
    const Frame sky(3, 3);
    const HitMetrics none = hit_metrics(sky, sky, rays, {64, 64});
    EXPECT_FALSE(none.missed_first_hit || none.early_hit || none.uv_error_texels || none.height_error || none.normal_error_deg ||
                 none.shadow_mismatch || none.fetches);
    EXPECT_EQ(none.missed_first_hit.reason, "the reference has no hit in any pixel");
    EXPECT_EQ(none.shadow_mismatch.reason, "the reference has no hit in any pixel");
    EXPECT_EQ(none.fetches.reason, "no surface was found in any pixel");

    Frame blind = plain_frame(3, 3);
    for (auto& c : blind.coverage.texels) c = test::no_hit;
    const HitMetrics lost = hit_metrics(blind, plain_frame(3, 3), rays, {64, 64});
    EXPECT_EQ(*lost.missed_first_hit, 1);
    EXPECT_EQ(*lost.early_hit, 0);
    EXPECT_EQ(lost.uv_error_texels.reason, "no surface was found in any pixel");
    EXPECT_EQ(lost.height_error.reason, "no surface was found in any pixel");

    const HitMetrics flat = hit_metrics(plain_frame(3, 3), plain_frame(3, 3), rays, {0, 0});
    EXPECT_EQ(flat.uv_error_texels.reason, "without a height map there is no texel to measure in");
    EXPECT_EQ(flat.missed_first_hit.reason, "without a height map there is no texel to measure in");
    EXPECT_TRUE(flat.normal_error_deg);
}

TEST(Hits, NumbersStayFiniteForAbsurdCoordinates) {
    const Frame reference = plain_frame(1, 1);
    Frame p = reference;
    p.hit_uv(0, 0, 0) = 3e38f;
    p.hit_height(0, 0) = -3e38f;
    const HitMetrics m = hit_metrics(p, reference, plain_rays(1, 1, from_minus_u), {4096, 4096});
    EXPECT_TRUE(std::isfinite(m.uv_error_texels->max));
    EXPECT_TRUE(std::isfinite(m.height_error->max));
    EXPECT_EQ(*m.missed_first_hit, 1);
}

std::string message_of(const Frame& p, const Frame& r, const RayField& rays, int threads) {
    try {
        hit_metrics(p, r, rays, {64, 64}, threads);
    } catch (const Error& e) {
        return e.what();
    }
    return "no error";
}

TEST(Hits, BadNumbersAreNamedByPlaneAndFirstPixel) {
    const Frame good = plain_frame(40, 60);
    const RayField rays = plain_rays(40, 60, from_minus_u);
    Frame p = good;
    p.hit_uv(11, 50, 1) = std::numeric_limits<float>::quiet_NaN();
    p.hit_height(7, 3) = std::numeric_limits<float>::infinity();
    for (const int threads : {1, 2, 5}) {
        const std::string message = message_of(p, good, rays, threads);
        EXPECT_NE(message.find("the picture"), std::string::npos) << message;
        EXPECT_NE(message.find("hit height at pixel (7, 3)"), std::string::npos) << message;
    }
    Frame r = good;
    r.normal(2, 1, 2) = 0;
    const std::string message = message_of(good, r, rays, 2);
    EXPECT_NE(message.find("the reference"), std::string::npos) << message;
    EXPECT_NE(message.find("normal at pixel (2, 1) has no length"), std::string::npos) << message;

    // What lies under pixels without a hit means nothing.
    Frame sky = good;
    sky.coverage(0, 0) = test::background;
    sky.hit_uv(0, 0, 0) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(message_of(sky, good, rays, 2), "no error");
}

// Against a second count written without the module's code, on random frames.
TEST(Hits, RandomFramesMatchAPlainCount) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    for (int trial = 0; trial < 20; ++trial) {
        const int w = 1 + static_cast<int>(random() % 30), h = 1 + static_cast<int>(random() % 30);
        Frame p = plain_frame(w, h), r = plain_frame(w, h);
        RayField rays = plain_rays(w, h, {1, 0, 1});
        double late = 0, early = 0, total = 0;
        std::vector<double> errors;
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < w; ++x) {
                const double angle = 6.28 * static_cast<double>(unit(random));
                rays.view(x, y, 0) = static_cast<float>(std::cos(angle));
                rays.view(x, y, 1) = static_cast<float>(std::sin(angle));
                for (int c = 0; c < 2; ++c) p.hit_uv(x, y, c) = 0.5f + 0.04f * (unit(random) - 0.5f);
                p.coverage(x, y) = static_cast<std::uint8_t>(random() % 3);
                r.coverage(x, y) = random() % 4 == 0 ? test::background : test::hit;
                if (r.coverage(x, y) != test::hit) continue;
                ++total;
                if (p.coverage(x, y) != test::hit) {
                    ++late;
                    continue;
                }
                const double dx = (static_cast<double>(p.hit_uv(x, y, 0)) - 0.5) * 128, dy = (static_cast<double>(p.hit_uv(x, y, 1)) - 0.5) * 128;
                const double along = -(dx * std::cos(angle) + dy * std::sin(angle));
                if (along > 0.5) ++late;
                if (along < -0.5) ++early;
                errors.push_back(std::hypot(dx, dy));
            }
        }
        if (errors.empty()) continue;
        std::sort(errors.begin(), errors.end());
        const HitMetrics m = hit_metrics(p, r, rays, {128, 128}, 1 + trial % 3);
        EXPECT_DOUBLE_EQ(*m.missed_first_hit, late / total);
        EXPECT_DOUBLE_EQ(*m.early_hit, early / total);
        EXPECT_NEAR(m.uv_error_texels->p50, errors[static_cast<std::size_t>(std::ceil(0.5 * static_cast<double>(errors.size()))) - 1], 1e-5);
        EXPECT_NEAR(m.uv_error_texels->max, errors.back(), 1e-5);
    }
}

}  // namespace
}  // namespace relievo
