#include "maps/cell_cone.h"

#include "core/error.h"
#include "core/map_set.h"
#include "maps/box_maximum.h"
#include "maps/fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace relievo {
namespace {

// UV distance of a point, in texel centres, from cell (x, y).
double distance_to_cell(const HeightField& f, int x, int y, double px, double py) {
    const double dx = std::max({0.0, x - px, px - (x + 1)}) / f.width();
    const double dy = std::max({0.0, y - py, py - (y + 1)}) / f.height();
    return std::hypot(dx, dy);
}

double height_at(const HeightField& f, double px, double py) {
    return f.sample({(px + 0.5) / f.width(), (py + 0.5) / f.height()});
}

// The largest c of a cell, or a little more: from points of the surface only, `per_cell` across each of its cells, corners and edges
// among them. Every point is taken at its repeats around the cell, of which others are farther.
double widest_by_sampling(const HeightField& f, int x, int y, double m, int per_cell) {
    double widest = 1;
    const int w = f.width() * per_cell;
    const int h = f.height() * per_cell;
    for (int j = 0; j < h; ++j)
        for (int i = 0; i < w; ++i) {
            const double px = static_cast<double>(i) / per_cell;
            const double py = static_cast<double>(j) / per_cell;
            const double rise = height_at(f, px, py) - m;
            if (rise <= 1e-9) continue;
            double nearest = 1e9;
            for (int b = -1; b <= 1; ++b)
                for (int a = -1; a <= 1; ++a) nearest = std::min(nearest, distance_to_cell(f, x, y, px + a * f.width(), py + b * f.height()));
            widest = std::min(widest, nearest / rise);
        }
    return widest;
}

// Whether h(p) <= m + distance / c, less a thousandth of c, all over a rectangle inside one cell: the distance, being convex, is nowhere below its tangent plane
// in the rectangle's middle; with that in its place the difference is bilinear and largest in a corner. Divided until that decides; the thousandth is what keeps this finite where c is the very slope.
bool holds(const HeightField& f, int x, int y, double m, double c, double x0, double x1, double y0, double y1, int depth = 0) {
    const double px = 0.5 * (x0 + x1);
    const double py = 0.5 * (y0 + y1);
    const double d = distance_to_cell(f, x, y, px, py);
    const double gap_x = px - std::clamp(px, static_cast<double>(x), x + 1.0);  // texels, signed
    const double gap_y = py - std::clamp(py, static_cast<double>(y), y + 1.0);
    const double slope_x = d > 0 ? gap_x / (d * f.width() * f.width()) : 0;
    const double slope_y = d > 0 ? gap_y / (d * f.height() * f.height()) : 0;
    bool decided = true;
    for (const double qx : {x0, x1})
        for (const double qy : {y0, y1})
            decided = decided && height_at(f, qx, qy) <= m + (d + slope_x * (qx - px) + slope_y * (qy - py)) / (0.999 * c) + 1e-9;
    if (decided) return true;
    if (depth == 30) {
        // Toward the cell's own corner the tangent planes never come near enough; there the height rises along a ray by its gradient at most.
        const double rise_x = std::max({0.0, height_at(f, x1, y0) - height_at(f, x0, y0), height_at(f, x1, y1) - height_at(f, x0, y1)});
        const double rise_y = std::max({0.0, height_at(f, x0, y1) - height_at(f, x0, y0), height_at(f, x1, y1) - height_at(f, x1, y0)});
        const double back_x = std::max({0.0, height_at(f, x0, y0) - height_at(f, x1, y0), height_at(f, x0, y1) - height_at(f, x1, y1)});
        const double back_y = std::max({0.0, height_at(f, x0, y0) - height_at(f, x0, y1), height_at(f, x1, y0) - height_at(f, x1, y1)});
        const double gradient = std::hypot((gap_x > 0 ? rise_x : back_x) / (x1 - x0) * f.width(), (gap_y > 0 ? rise_y : back_y) / (y1 - y0) * f.height());
        const bool beside_corner = d < 64 * std::hypot((x1 - x0) / f.width(), (y1 - y0) / f.height()) && gap_x != 0 && gap_y != 0;
        return beside_corner && gradient * 0.999 * c <= 1;
    }
    return (x1 - x0) * f.height() >= (y1 - y0) * f.width() ? holds(f, x, y, m, c, x0, px, y0, y1, depth + 1) && holds(f, x, y, m, c, px, x1, y0, y1, depth + 1)
                          : holds(f, x, y, m, c, x0, x1, y0, py, depth + 1) && holds(f, x, y, m, c, x0, x1, py, y1, depth + 1);
}

void expect_valid_and_tight(const HeightField& f, int per_cell) {
    const bool square = std::max(f.width(), f.height()) < 2.6 * std::min(f.width(), f.height());
    const int w = f.width();
    const int h = f.height();
    const ImageF map = cell_cone_map(f);
    double tightness = 0;
    ASSERT_EQ(map.channels, 4);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const auto corners = f.cell(x, y);
            const float highest = *std::ranges::max_element(corners);
            const float m = map(x, y, 0);
            ASSERT_GE(m, highest);
            ASSERT_LT(m, highest + 1.01f / 65535);
            const double c = map(x, y, 1);
            const double widest = widest_by_sampling(f, x, y, m, per_cell);
            ASSERT_GT(c, 0);
            ASSERT_LE(c, 1);
            ASSERT_LE(c, widest) << w << 'x' << h << " cell " << x << ' ' << y;
            ASSERT_GE(c, (square ? 0.5 : 0.15) * widest) << w << 'x' << h << " cell " << x << ' ' << y;
            tightness += c / widest / (w * h);
            for (int j = y - h; j <= y + h; ++j)
                for (int i = x - w; i <= x + w; ++i)
                    ASSERT_TRUE((i == x && j == y) || holds(f, x, y, m, c, i, i + 1, j, j + 1)) << w << 'x' << h << " cell " << x << ' ' << y << " is pierced by " << i << ' ' << j;
        }
    EXPECT_GE(tightness, square ? 0.85 : 0.4);
}

TEST(CellCone, FlatFieldIsWideOpen) {
    for (const float level : {0.0f, 13107 / 65535.0f, 1.0f}) {
        const ImageF map = cell_cone_map(HeightField(9, 4, level));
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 9; ++x) {
                EXPECT_EQ(map(x, y, 0), level);
                EXPECT_EQ(map(x, y, 1), 1.0f);
                EXPECT_EQ(map(x, y, 2), level);
                EXPECT_EQ(map(x, y, 3), level);
            }
    }
}

// A ridge across the field, of height 1 along column 20: a cell's cone is limited by the nearer of it and its next repeat, where a
// texel counts as nearer than it is, sqrt(r^2 - 1/2) for r, from the second on.
TEST(CellCone, RidgeGivesTheDistanceToIt) {
    HeightField f(40, 40);
    for (int y = 0; y < 40; ++y) f.texels(20, y) = 1;
    const ImageF map = cell_cone_map(f);
    for (int x = 0; x < 40; ++x) {
        const double r = std::min((20 - (x + 1) + 40) % 40, (x - 20 + 40) % 40);
        const double expected = x == 19 || x == 20 ? 1.0 : (r < 2 ? r : std::sqrt(r * r - 0.5)) / 40;
        EXPECT_NEAR(map(x, 3, 1), expected, 1.01 / 65535) << x;
    }
}

// Beside the cell, and in its corner, the slope of the surface is exact.
TEST(CellCone, SlopesBesideTheCellAreExact) {
    HeightField beside(32, 32);
    for (int y = 0; y < 32; ++y)
        for (int x = 10; x < 22; ++x) beside.texels(x, y) = 0.25f * static_cast<float>(std::min({x - 9, 22 - x, 4}));
    const ImageF map = cell_cone_map(beside);
    // In cell 8, at M = 0, column 10 is 1/4 at one texel; columns 11, 12, 13 are as steep, but counted as nearer than they are: 3/4 at
    // sqrt(9 - 1/2) is steepest.
    EXPECT_NEAR(map(8, 5, 1), std::sqrt(3.5) / 2 / 32 / 0.25, 1.01 / 65535);
    EXPECT_EQ(map(13, 5, 1), 1.0f);
    // A pyramid's apex one texel from the corner of cell (8, 8) in both directions, its edges sloping 0.3 and 0.4 on the way.
    HeightField corner(32, 32);
    corner.texels(10, 9) = 0.3f;
    corner.texels(9, 10) = 0.4f;
    corner.texels(10, 10) = 0.35f;
    EXPECT_NEAR(cell_cone_map(corner)(8, 8, 1), 1.0 / 32 / 0.5, 1.01 / 65535);
}

TEST(CellCone, HoldsNothingOfTheSurfaceAndIsTight) {
    constexpr int sizes[][2] = {{16, 16}, {13, 9}, {9, 11}, {1, 1}, {2, 1}, {3, 2}, {1, 20}, {20, 1}, {5, 24}, {18, 4}};
    for (const auto& s : sizes)
        for (const HeightField& field : {test::random_field(s[0], s[1], 3), test::terraced_field(s[0], s[1], 4), test::smooth_field(s[0], s[1], 5),
                                         test::spike_field(s[0], s[1], s[0] / 3, s[1] / 2)})
            expect_valid_and_tight(field, 4);
}

// Saddles, whose ridges run between texels, and ridges that run slantwise.
TEST(CellCone, SaddlesAndSlantingRidgesStayOutside) {
    HeightField saddles(14, 14);
    HeightField ridges(14, 14);
    for (int j = 0; j < 14; ++j)
        for (int i = 0; i < 14; ++i) {
            saddles.texels(i, j) = (i + j) % 2 == 0 ? 0.8f : 0.2f;
            ridges.texels(i, j) = (i + 2 * j) % 7 == 0 ? 0.9f : 0.05f * static_cast<float>((i * 5 + j * 3) % 4);
        }
    expect_valid_and_tight(saddles, 6);
    expect_valid_and_tight(ridges, 6);
}

TEST(CellCone, RoofsAreTheMaximaAround) {
    const HeightField f = test::random_field(80, 11, 6);
    const ImageF map = cell_cone_map(f);
    for (int y = 0; y < 11; ++y)
        for (int x = 0; x < 80; ++x)
            for (const auto& [channel, reach] : {std::pair{2, near_roof_reach}, std::pair{3, far_roof_reach}}) {
                float most = 0;
                for (int j = -reach; j <= reach; ++j)
                    for (int i = -reach; i <= reach; ++i) most = std::max(most, map(wrap_index(x + i, 80), wrap_index(y + j, 11), 0));
                ASSERT_EQ(map(x, y, channel), most) << x << ' ' << y;
            }
}

TEST(CellCone, TinyRisesDoNotUnderflow) {
    HeightField field(8, 8, 0.0f);
    field.texels(1, 1) = 1e-30f;
    field.texels(5, 2) = 1e-38f;
    const ImageF map = cell_cone_map(field);
    for (const float v : map.texels) EXPECT_TRUE(std::isfinite(v));
    EXPECT_EQ(map(3, 5, 1), 1.0f);
}

// A device holds every channel in 16 bits without moving it; heights that are such numbers keep their maxima.
TEST(CellCone, ValuesAreWholeNumbersOf16Bits) {
    const HeightField field = test::terraced_field(40, 30, 9);
    const ImageF map = cell_cone_map(field);
    for (const float v : map.texels) ASSERT_EQ(v, static_cast<float>(std::round(v * 65535.0) / 65535.0));
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x) {
            const auto corners = field.cell(x, y);
            ASSERT_EQ(map(x, y, 0), *std::ranges::max_element(corners));
        }
}

TEST(CellCone, DoesNotDependOnThreads) {
    const HeightField field = test::smooth_field(150, 90, 8);
    const ImageF one = cell_cone_map(field, 1);
    EXPECT_EQ(one.texels, cell_cone_map(field, 2).texels);
    EXPECT_EQ(one.texels, cell_cone_map(field, 7).texels);
}

TEST(CellCone, ReportsProgressAndStopsWhenCancelled) {
    double last = 0;
    cell_cone_map(test::random_field(64, 64, 1), 2, [&](std::string_view stage, double share) {
        EXPECT_FALSE(stage.empty());
        EXPECT_GE(share, last);
        EXPECT_LE(share, 1.0);
        last = share;
    });
    EXPECT_EQ(last, 1.0);
    int calls = 0;
    EXPECT_THROW(cell_cone_map(test::random_field(256, 256, 1), 2,
                               [&](std::string_view, double) {
                                   if (++calls == 2) throw Cancelled();
                               }),
                 Cancelled);
}

}  // namespace
}  // namespace relievo
