#include "maps/planes_above.h"

#include "maps/fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace relievo {
namespace {

float plane_at(const ImageF& planes, int level, int x, int y) {
    const float* p = planes.at(x >> level, y >> level);
    const int inside = (1 << level) - 1;
    return p[0] + p[1] * static_cast<float>(x & inside) + p[2] * static_cast<float>(y & inside);
}

TEST(PlanesAbove, NoTexelIsAbove) {
    for (const auto& [w, h] : {std::pair{1, 1}, {5, 1}, {1, 9}, {16, 16}, {37, 21}, {64, 3}})
        for (const HeightField& field : {test::random_field(w, h, 1), test::terraced_field(w, h, 2), test::smooth_field(w, h, 3),
                                         test::spike_field(w, h, w / 3, h / 2)}) {
            const std::vector<ImageF> planes = planes_above(field.texels, 2, 6);
            ASSERT_EQ(planes.size(), 5u);
            for (int level = 2; level <= 6; ++level)
                for (int y = 0; y < h; ++y)
                    for (int x = 0; x < w; ++x)
                        ASSERT_GE(plane_at(planes[static_cast<std::size_t>(level - 2)], level, x, y), field.texels(x, y) - 0x1p-21f)
                            << w << 'x' << h << " level " << level << " at " << x << ' ' << y;
        }
}

// A tilted plane is its own bound, on blocks that the map cuts off too.
TEST(PlanesAbove, AreTheSurfaceWhereItIsAPlane) {
    HeightField tilted(29, 22);
    for (int y = 0; y < 22; ++y)
        for (int x = 0; x < 29; ++x) tilted.texels(x, y) = 0.1f + static_cast<float>(x) / 64 + static_cast<float>(y) / 128;
    const std::vector<ImageF> planes = planes_above(tilted.texels, 2, 5);
    for (int level = 2; level <= 5; ++level)
        for (int y = 0; y < 22; ++y)
            for (int x = 0; x < 29; ++x)
                EXPECT_NEAR(plane_at(planes[static_cast<std::size_t>(level - 2)], level, x, y), tilted.texels(x, y), 1e-6f);
}

// On a smooth field a plane leaves far less room above a block than its highest texel does.
TEST(PlanesAbove, FitSmoothFieldsClosely) {
    const HeightField field = test::smooth_field(256, 256, 5);
    const ImageF planes = planes_above(field.texels, 3, 3)[0];
    double room = 0;
    double room_below_highest = 0;
    for (int y = 0; y < 256; ++y)
        for (int x = 0; x < 256; ++x) {
            float highest = 0;
            for (int b = 0; b < 8; ++b)
                for (int a = 0; a < 8; ++a) highest = std::max(highest, field.texels((x & ~7) + a, (y & ~7) + b));
            room += plane_at(planes, 3, x, y) - field.texels(x, y);
            room_below_highest += highest - field.texels(x, y);
        }
    EXPECT_LT(room, 0.2 * room_below_highest);
}

}  // namespace
}  // namespace relievo
