#include "maps/cone_verifier.h"

#include "core/error.h"
#include "maps/cone_map.h"
#include "maps/conservative_cone.h"
#include "maps/fields.h"
#include "maps/max_pyramid.h"
#include "maps/pyramid_verifier.h"
#include "maps/quick_cone.h"
#include "maps/relaxed_cone.h"
#include "maps/safe_rounding.h"
#include "maps/surface_slopes.h"

#include <gtest/gtest.h>


namespace relievo {
namespace {

constexpr std::array<Rounding, 4> safe = {Rounding::up, Rounding::down, Rounding::nearest, Rounding::nearest};

std::vector<HeightField> fields() {
    std::vector<HeightField> all;
    for (const auto& [w, h] : {std::pair{1, 1}, {2, 1}, {1, 9}, {8, 8}, {13, 7}, {31, 18}, {64, 40}})
        for (const HeightField& field : {test::random_field(w, h, 1), test::terraced_field(w, h, 2), test::smooth_field(w, h, 3), test::spike_field(w, h, w / 3, h / 2)})
            all.push_back(field);
    return all;
}

TEST(ConeVerifier, ProvesOurCones) {
    for (const HeightField& field : fields()) {
        const Verification conservative = verify_cones(field, texel_cones(as_stored(conservative_cone(field), safe)), ConePromise::conservative);
        EXPECT_EQ(conservative.violated, 0u);
        EXPECT_EQ(conservative.undecided, 0u);
        const auto texels = static_cast<std::uint64_t>(field.width() * field.height());
        EXPECT_EQ(conservative.cones, texels);
        EXPECT_EQ(conservative.pairs, texels * texels * 9) << "every cell of every repeat is decided for every cone";
        EXPECT_GE(conservative.checks, conservative.cones);
        const Verification relaxed = verify_cones(field, texel_cones(as_stored(relaxed_cone(field), safe)), ConePromise::relaxed);
        EXPECT_EQ(relaxed.violated, 0u);
        EXPECT_EQ(relaxed.undecided, 0u);
    }
}

// One part in a thousand too wide is found at every texel whose cone is limited at all, and one in 10^5 too narrow is kept.
TEST(ConeVerifier, FindsPlantedViolations) {
    for (const ConePromise promise : {ConePromise::conservative, ConePromise::relaxed})
        for (const HeightField& field : {test::random_field(12, 9, 4), test::smooth_field(14, 10, 5), test::spike_field(7, 11, 3, 3)})
            for (int y = 0; y < field.height(); ++y)
                for (int x = 0; x < field.width(); ++x) {
                    const double widest = test::surface_ratio(field, x, y, {.falling_only = promise == ConePromise::relaxed, .lines = 64});
                    if (widest > 0.998) continue;
                    ConeApex cone{static_cast<double>(x), static_cast<double>(y), field.texels(x, y), widest * 1.002};
                    ASSERT_EQ(verify_cones(field, {&cone, 1}, promise).violated, 1u) << x << ' ' << y;
                    cone.ratio = widest * (1 - 1e-3);
                    const Verification narrower = verify_cones(field, {&cone, 1}, promise);
                    ASSERT_EQ(narrower.violated + narrower.undecided, 0u) << x << ' ' << y;
                }
}

// An edge as steep as the cone, to 2^-20, from the apex on, and cells twisted upward on both sides of it: the cone all but touches along a line.
TEST(ConeVerifier, DecidesConesThatTouchAlongAnEdge) {
    HeightField field(32, 32);
    for (int j = 0; j < 32; ++j)
        for (int i = 0; i < 32; ++i) {
            const double x = i % 8;
            const double y = std::abs(j % 8 - 4);
            field.texels(i, j) = static_cast<float>(0.25 + 0.046875 * x - 0.03125 * y + 0.001953125 * x * y);
        }
    for (const int i : {4, 5}) {
        const double h = field.texels(i, 4);
        ConeApex cone{static_cast<double>(i), 4, h, (1 - 0x1p-20) / (32 * (field.texels(i + 1, 4) - h))};
        const Verification kept = verify_cones(field, {&cone, 1}, ConePromise::conservative);
        EXPECT_EQ(kept.violated + kept.undecided, 0u) << i;
        EXPECT_LT(kept.checks, 20000u) << i;
        cone.ratio *= 1 + 0x1p-18;
        EXPECT_EQ(verify_cones(field, {&cone, 1}, ConePromise::conservative).violated, 1u) << i;
    }
}

// The verifier against plain sampling, from apexes anywhere on the surface: whatever a sample breaks it calls broken.
TEST(ConeVerifier, AgreesWithSamplingAnywhere) {
    const HeightField field = test::smooth_field(16, 12, 6);
    ImageF ratios(16, 12, 2);
    std::mt19937 random(7);
    for (int k = 0; k < 16 * 12; ++k) ratios.texels[static_cast<std::size_t>(2 * k + 1)] = static_cast<float>(random() >> 8) * 0x1p-24f;
    int broken = 0;
    int kept = 0;
    for (const ConeApex& cone : scattered_cones(field, ratios, 3)) {
        bool sampled = false;
        for (int j = -12 * 8; j < 12 * 8 && !sampled; ++j)
            for (int i = -16 * 8; i < 16 * 8; ++i) {
                const Vec2d from{(cone.x + 0.5) / 16, (cone.y + 0.5) / 12};
                const Vec2d away{(i + 0.5) / (8 * 16), (j + 0.5) / (8 * 12)};
                sampled |= cone.ratio * (field.sample({from.x + away.x, from.y + away.y}) - cone.height) > std::hypot(away.x, away.y) + 1e-9;
            }
        const Verification v = verify_cones(field, {&cone, 1}, ConePromise::conservative);
        EXPECT_EQ(v.undecided, 0u);
        EXPECT_TRUE(!sampled || v.violated == 1u) << cone.x << ' ' << cone.y << " ratio " << cone.ratio;
        broken += v.violated > 0;
        kept += v.violated == 0;
        EXPECT_EQ(v.violated > 0, v.deepest > 0);
    }
    EXPECT_GT(broken, 8);
    EXPECT_GT(kept, 20);
}

// The edge of two texels of ConservativeCone.EdgeBindsBetweenItsEnds: the sampled cone is pierced between its samples.
TEST(ConeVerifier, FindsSampledConesTooWide) {
    HeightField edge(64, 64);
    edge.texels(4, 0) = 0.5f;
    edge.texels(4, 1) = 0.52f;
    const std::vector<ConeApex> cones = texel_cones(as_stored(cone_map(edge), safe));
    EXPECT_EQ(verify_cones(edge, {&cones[0], 1}, ConePromise::conservative).violated, 1u);
    const Verification all = verify_cones(edge, cones, ConePromise::conservative);
    EXPECT_GT(all.violated, 10u);
    EXPECT_LT(all.violated, all.cones / 2);
}

TEST(ConeVerifier, AnApexInTheSolidIsBroken) {
    const HeightField level(5, 5, 0.5f);
    const ConeApex below{2, 2, 0.49, 0.3};
    const ConeApex on{2.25, 1.75, 0.5, 1.0};
    EXPECT_EQ(verify_cones(level, {&below, 1}, ConePromise::conservative).violated, 1u);
    EXPECT_EQ(verify_cones(level, {&on, 1}, ConePromise::conservative).violated, 0u);
}

TEST(ConeVerifier, DoesNotDependOnThreads) {
    const HeightField field = test::smooth_field(60, 45, 2);
    const std::vector<ConeApex> cones = texel_cones(as_stored(cone_map(field), safe));
    const Verification one = verify_cones(field, cones, ConePromise::conservative, 1);
    const Verification five = verify_cones(field, cones, ConePromise::conservative, 5);
    EXPECT_GT(one.violated, 0u);
    EXPECT_EQ(one.violated, five.violated);
    EXPECT_EQ(one.checks, five.checks);
    EXPECT_EQ(one.pairs, five.pairs);
    EXPECT_EQ(one.first.x, five.first.x);
    EXPECT_EQ(one.deepest, five.deepest);
}

TEST(ConeVerifier, RefusesWhatIsNoCone) {
    const HeightField field(4, 4);
    for (const ConeApex& bad : {ConeApex{0, 0, 0, 1.5}, ConeApex{0, 0, 0, -0.1}, ConeApex{0, 0, 2, 0.5}, ConeApex{0, 0, NAN, 0.5}})
        EXPECT_THROW(verify_cones(field, {&bad, 1}, ConePromise::conservative), Error);
}

TEST(PyramidVerifier, ProvesOursAndFindsALoweredNode) {
    for (const auto& [w, h] : {std::pair{1, 1}, {16, 16}, {21, 10}, {70, 33}}) {
        const HeightField field = test::random_field(w, h, 3);
        MaxPyramid pyramid = max_pyramid(field);
        const PyramidVerification kept = verify_max_pyramid(field, pyramid);
        EXPECT_EQ(kept.violated, 0u);
        EXPECT_EQ(kept.cells, static_cast<std::uint64_t>(w * h) * pyramid.levels.size());
        for (ImageF& level : pyramid.levels) {
            const float was = level(0, 0);
            level(0, 0) = std::nextafter(was, 0.0f);
            EXPECT_GE(verify_max_pyramid(field, pyramid).violated, 1u);
            level(0, 0) = was;
        }
    }
    EXPECT_THROW(verify_max_pyramid(HeightField(4, 4), max_pyramid(HeightField(5, 4))), Error);
}

TEST(QuickCone, IsNeverWiderThanTheSampledConeAndMostlyNarrower) {
    for (const auto& [w, h] : {std::pair{1, 1}, {32, 32}, {45, 20}}) {
        const HeightField field = test::smooth_field(w, h, 9);
        const ImageF quick = quick_cone(field);
        const ImageF sampled = cone_map(field);
        int narrower = 0;
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                ASSERT_LE(quick(x, y, 1), sampled(x, y, 1) * (1 + 1e-6f));
                narrower += quick(x, y, 1) < sampled(x, y, 1) * 0.99f;
            }
        EXPECT_TRUE(w == 1 || narrower > w * h / 10);
    }
}

// A lone spike at 16 of 32: blocks of 16 texels see it at their nearest texel on both sides, at x + 1 to the left and at 16 - x.
TEST(QuickCone, SeesALoneSpikeAtTheNearestTexelOfItsBlock) {
    const ImageF quick = quick_cone(test::spike_field(32, 32, 16, 16));
    for (int x = 0; x < 16; ++x) EXPECT_NEAR(quick(x, 16, 1), std::min(x + 1, 16 - x) / 32.0, 1e-6) << x;
}

}  // namespace
}  // namespace relievo
