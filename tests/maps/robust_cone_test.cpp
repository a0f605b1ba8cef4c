#include "maps/robust_cone.h"

#include "maps/cone_map.h"
#include "maps/fields.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

TEST(RobustCone, IsTheLeastOfNineNeighboursAcrossTheSeam) {
    for (const auto& [w, h] : {std::pair{1, 1}, {2, 3}, {13, 7}}) {
        const HeightField field = test::random_field(w, h, 3);
        const ImageF sampled = cone_map(field);
        const ImageF robust = robust_cone(field);
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x) {
                float least = 2;
                for (int k = 0; k < 9; ++k) least = std::min(least, sampled((x + w + k % 3 - 1) % w, (y + h + k / 3 - 1) % h, 1));
                ASSERT_EQ(robust(x, y, 1), least);
                ASSERT_EQ(robust(x, y, 0), field.texels(x, y));
            }
    }
}

TEST(RobustCone, DoesNotDependOnThreads) {
    const HeightField field = test::smooth_field(70, 90, 8);
    EXPECT_EQ(robust_cone(field, 1).texels, robust_cone(field, 5).texels);
}

}  // namespace
}  // namespace relievo
