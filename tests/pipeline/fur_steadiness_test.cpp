// How steady frames are, on frames of one pixel that are known, and where a film is seen from.
#include "pipeline/fur_steadiness.h"

#include "pipeline/fur_path.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

// Two pixels; the second is bare and counts for nothing.
FurFrames grey(float value) {
    FurFrames f;
    f.colour = ImageF(2, 1, 3);
    f.coverage = ImageF(2, 1, 1);
    f.coverage(0, 0) = 1;
    for (int c = 0; c < 3; ++c) f.colour(0, 0, c) = value;
    return f;
}

TEST(FurSteadiness, IsTheMeanChangeOfPictureReferenceAndDifference) {
    SteadinessMeter meter({1, 4}, 8);
    meter.add({.distance = 1, .layers = 5, .pictures = {grey(0), grey(0.5f)}, .reference = grey(0.25f), .as_layered_before = {}});
    EXPECT_FALSE(meter.result());
    meter.add({.distance = 2, .layers = 5, .pictures = {grey(0.5f), grey(0.5f)}, .reference = grey(0.5f), .as_layered_before = {}});
    meter.add({.distance = 3, .layers = 4, .pictures = {grey(0.25f), grey(0.625f)}, .reference = grey(0.75f), .as_layered_before = {grey(0.5f), grey(0.5625f)}});
    const FurSteadiness s = *meter.result();
    EXPECT_EQ(s.samples, 8);
    ASSERT_EQ(s.rows.size(), 2u);
    EXPECT_EQ(s.rows[0].passes, 1);
    EXPECT_DOUBLE_EQ(s.rows[0].mean.picture, 0.375);            // 0.5 and 0.25
    EXPECT_DOUBLE_EQ(s.rows[0].mean.reference, 0.25);
    EXPECT_DOUBLE_EQ(s.rows[0].mean.error, 0.375);              // 0.25 and 0.5
    EXPECT_DOUBLE_EQ(s.rows[0].mean.layers, 0.25);              // of the step that changes them
    EXPECT_DOUBLE_EQ(s.rows[0].pop, 1);                         // all that changes there is their number
    EXPECT_DOUBLE_EQ(s.rows[0].worst_over_median, 1);           // of two, the upper is the median
    EXPECT_FALSE(s.rows[0].inside());
    EXPECT_EQ(s.rows[1].passes, 4);
    EXPECT_DOUBLE_EQ(s.rows[1].mean.picture, 0.0625);           // 0 and 0.125
    EXPECT_DOUBLE_EQ(s.rows[1].mean.error, (0.25 + 0.125) / 2);
    EXPECT_DOUBLE_EQ(s.rows[1].pop, 0.5);
    EXPECT_FALSE(s.rows[1].inside());                           // it pops
    FurSteadiness::Row calm = s.rows[1];
    calm.pop = most_pop;
    EXPECT_TRUE(calm.inside());
    calm.mean.error = 1.01 * calm.mean.reference;
    EXPECT_FALSE(calm.inside());
    ASSERT_EQ(s.steps.size(), 2u);
    EXPECT_EQ(s.steps[1].layers, 4);
    EXPECT_EQ(s.steps[1].distance, 3);
    EXPECT_DOUBLE_EQ(s.steps[0].change.picture, 0);
    EXPECT_DOUBLE_EQ(s.steps[1].change.layers, 0.0625);
}

TEST(FurPath, TurnsAroundTheMeshAndKeepsItBetweenNearAndFar) {
    FurView view{.camera = view_of_sphere({0, 0, 0}, 1.1, 64, 48)};
    const Vec3d eye = view.camera.camera.eye;
    const FurView quarter = turned(view, 3.14159265358979323846 / 2);
    // The camera goes clockwise where the mesh would turn counter-clockwise: from +z to -x.
    EXPECT_NEAR(quarter.camera.camera.eye.x, -eye.z, 1e-12);
    EXPECT_NEAR(quarter.camera.camera.eye.z, eye.x, 1e-12);
    EXPECT_DOUBLE_EQ(quarter.camera.camera.eye.y, eye.y);
    for (const double factor : {nearest_dolly, 1.0, 3.0, 100.0}) {
        const FurView seen = from_afar(view, factor);
        const double distance = length(seen.camera.camera.eye);
        EXPECT_NEAR(distance, factor * length(eye), 1e-9);
        EXPECT_GT(seen.camera.near, 0) << factor;
        EXPECT_LT(seen.camera.near, distance - 1.1) << factor;
        EXPECT_GT(seen.camera.far, distance + 1.1) << factor;
    }
    EXPECT_EQ(from_afar(view, 1).camera.near, view.camera.near);
}

}  // namespace
}  // namespace relievo
