// The 3D distance map: never more than the true distance for any point that reads it, and not much less.
#include "maps/distance_map.h"

#include "maps/fields.h"
#include "techniques/glsl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace relievo {
namespace {

struct Baked {
    MapSet maps;
    double scale = 0;     // of the metric
    double diagonal = 0;  // of a voxel, in heights

    Baked(HeightField field, float height_scale, int threads = 0) {
        maps.distance = distance_map(field, height_scale, threads);
        const double w = maps.distance.width;
        const double h = maps.distance.height / distance_slices;
        scale = std::max(static_cast<double>(height_scale), 8 / std::min(w, h));
        diagonal = std::sqrt(1 / (scale * w * scale * w) + 1 / (scale * h * scale * h) + 1 / std::pow(distance_slices - 1, 2));
        maps.height = std::move(field);
    }
    // What a technique reads.
    double read(double u, double v, double z) const {
        glsl::bound_maps = {.maps = &maps, .readable = MapFlags().set()};
        return glsl::distance_at({static_cast<float>(u), static_cast<float>(v), static_cast<float>(z)});
    }
};

// Distance from p to the solid under the bilinear surface, cell by cell: a grid of 5 x 5 points, then ever smaller steps from the best.
// At least the true one, by less than 1e-5.
double by_definition(const HeightField& field, double scale, double u, double v, double z) {
    const double x = u * field.width() - 0.5;
    const double y = v * field.height() - 0.5;
    const double a = 1 / (field.width() * scale);
    const double b = 1 / (field.height() * scale);
    double best = std::pow(std::max(0.0, z - field.sample({u, v})), 2);
    const int reach_x = static_cast<int>(std::sqrt(best) / a) + 2;
    const int reach_y = static_cast<int>(std::sqrt(best) / b) + 2;
    const int i0 = static_cast<int>(std::floor(x));
    const int j0 = static_cast<int>(std::floor(y));
    for (int j = j0 - reach_y; j <= j0 + reach_y; ++j) {
        for (int i = i0 - reach_x; i <= i0 + reach_x; ++i) {
            const auto c = field.cell(i, j);
            const double across = std::pow(a * std::max({i - x, x - i - 1, 0.0}), 2) + std::pow(b * std::max({j - y, y - j - 1, 0.0}), 2);
            if (across + std::pow(std::max(0.0, z - static_cast<double>(std::ranges::max(c))), 2) >= best) continue;
            const auto squared = [&](double fx, double fy) {
                const double h = (c[0] * (1 - fx) + c[1] * fx) * (1 - fy) + (c[2] * (1 - fx) + c[3] * fx) * fy;
                return std::pow(a * (i + fx - x), 2) + std::pow(b * (j + fy - y), 2) + std::pow(std::max(0.0, z - h), 2);
            };
            double fx = 0, fy = 0, here = 1e30;
            for (int k = 0; k < 25; ++k)
                if (const double d = squared(k % 5 / 4.0, k / 5 / 4.0); d < here) here = d, fx = k % 5 / 4.0, fy = k / 5 / 4.0;
            for (double step = 0.125; step > 1e-4;) {
                const Vec2d before{fx, fy};
                for (const Vec2d d : {Vec2d{step, 0}, {-step, 0}, {0, step}, {0, -step}}) {
                    const double nx = std::clamp(before.x + d.x, 0.0, 1.0);
                    const double ny = std::clamp(before.y + d.y, 0.0, 1.0);
                    if (const double s = squared(nx, ny); s < here) here = s, fx = nx, fy = ny;
                }
                if (before == Vec2d{fx, fy}) step /= 2;
            }
            best = std::min(best, here);
        }
    }
    return std::sqrt(best);
}

struct Judged {
    double over = -1e9;        // largest excess over the true distance
    double far_loss = 0;       // mean shortfall where the distance is over three diagonals, in diagonals
    double far_loss_most = 0;
};

Judged judge(const Baked& baked, int points, unsigned seed) {
    std::mt19937 random(seed);
    const auto unit = [&] { return static_cast<double>(random() >> 8) * 0x1p-24; };
    Judged judged;
    int far = 0;
    for (int k = 0; k < points; ++k) {
        const double u = 3 * unit() - 1;
        const double v = 3 * unit() - 1;
        const double z = unit();
        const double d = by_definition(baked.maps.height, baked.scale, u, v, z);
        const double read = baked.read(u, v, z);
        judged.over = std::max(judged.over, read - d);
        if (d < 3 * baked.diagonal) continue;
        judged.far_loss += (d - read) / baked.diagonal;
        judged.far_loss_most = std::max(judged.far_loss_most, (d - read) / baked.diagonal);
        ++far;
    }
    if (far > 0) judged.far_loss /= far;
    return judged;
}

// uv in float is off by up to 1e-7 of three repeats, and the definition's own search by as much as its last step.
constexpr double rounding = 1e-5;

TEST(DistanceMap, OverALevelFieldIsTheHeightOverIt) {
    for (const float level : {0.0f, 0.3f}) {
        const Baked baked(HeightField(32, 16, level), 0.5f);
        for (const double z : {0.45, 0.7, 1.0}) {
            const double d = z - static_cast<double>(level);
            const double read = baked.read(0.37, 0.61, z);
            EXPECT_LE(read, d + rounding);
            if (d > 3 * baked.diagonal) {
                EXPECT_GE(read, d - 0.3 * baked.diagonal) << level << ' ' << z;
            }
        }
    }
}

// A spike on the floor, far from the point: the distance is to the column's edge, through the repeat where that is nearer.
TEST(DistanceMap, SeesASpikeThroughTheSeam) {
    const Baked baked(test::spike_field(64, 64, 1, 32), 2.0f);
    const double z = 0.95;
    const double u = 60.5 / 64;  // 5 texels from the spike through the seam, 59 the other way
    const double d = by_definition(baked.maps.height, baked.scale, u, 32.5 / 64, z);
    EXPECT_LT(d, 5.0 / 64 / 2 + 1e-6);
    EXPECT_LE(baked.read(u, 32.5 / 64, z), d + rounding);
    EXPECT_GE(baked.read(u, 32.5 / 64, z), d - 2 * baked.diagonal);
}

TEST(DistanceMap, NeverSaysMoreThanTheDistanceAndHardlyLess) {
    for (const float height_scale : {0.0f, 0.1f, 0.3f}) {
        const Judged smooth = judge(Baked(test::smooth_field(56, 40, 7), height_scale), 300, 1);
        EXPECT_LE(smooth.over, rounding) << height_scale;
        EXPECT_LE(smooth.far_loss, 0.5) << height_scale;
        EXPECT_LE(judge(Baked(test::random_field(40, 56, 8), height_scale), 300, 2).over, rounding) << height_scale;
        EXPECT_LE(judge(Baked(test::terraced_field(48, 48, 9), height_scale), 300, 3).over, rounding) << height_scale;
        EXPECT_LE(judge(Baked(test::spike_field(48, 30, 2, 28), height_scale), 200, 4).over, rounding) << height_scale;
    }
}

// More texels than voxels: the coarser surface is nowhere below the field.
TEST(DistanceMap, IsSafeWhereItIsCoarserThanTheField) {
    HeightField field = test::smooth_field(700, 24, 10);
    const HeightField rough = test::random_field(700, 24, 11);
    for (std::size_t i = 0; i < field.texels.texels.size(); ++i)
        field.texels.texels[i] = 0.8f * field.texels.texels[i] + 0.2f * rough.texels.texels[i];
    const Baked baked(std::move(field), 0.2f);
    ASSERT_EQ(baked.maps.distance.width, 512);
    ASSERT_EQ(baked.maps.distance.height, 24 * distance_slices);
    EXPECT_LE(judge(baked, 300, 12).over, rounding);
}

// Half floats hold the values as they are, and grids of fields as small as a texel work.
TEST(DistanceMap, HoldsHalfFloats) {
    for (const auto& [w, h] : {std::pair{1, 1}, {1, 7}, {5, 1}, {33, 20}}) {
        const ImageF map = distance_map(test::random_field(w, h, 13), 0.1f);
        ASSERT_EQ(map.width, w);
        for (const float value : map.texels) {
            ASSERT_TRUE(std::isfinite(value));
            ASSERT_LE(value, 1.0f);
            ASSERT_GE(value, -1.0f);
            ASSERT_EQ(std::ldexp(value, 24), std::round(std::ldexp(value, 24))) << "below a half's last place";
            int exponent = 0;
            const float fraction = std::frexp(value, &exponent);
            ASSERT_EQ(std::ldexp(fraction, 11), std::round(std::ldexp(fraction, 11))) << "more digits than a half has";
        }
    }
}

TEST(DistanceMap, DoesNotDependOnThreads) {
    const HeightField field = test::random_field(70, 41, 14);
    const ImageF one = distance_map(field, 0.1f, 1);
    EXPECT_EQ(one.texels, distance_map(field, 0.1f, 2).texels);
    EXPECT_EQ(one.texels, distance_map(field, 0.1f, 7).texels);
}

}  // namespace
}  // namespace relievo
