// Noise, cells, packed stones, carvings and waves by themselves.
#include "textures/carving.h"
#include "textures/cellular.h"
#include "textures/curves.h"
#include "textures/distance.h"
#include "textures/hash.h"
#include "textures/lettering.h"
#include "textures/noise.h"
#include "textures/stone_packing.h"
#include "textures/wave_field.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace relievo {
namespace {

// Multiples of 1/4096: a whole period can be added to them without rounding.
Vec2f dyadic(Dice& dice) { return {static_cast<float>(dice.bits() >> 20) / 4096, static_cast<float>(dice.bits() >> 20) / 4096}; }

TEST(curves, cos_turns_is_the_cosine) {
    for (int k = -4000; k <= 4000; ++k) {
        const float t = static_cast<float>(k) / 1000;
        EXPECT_NEAR(cos_turns(t), std::cos(2 * std::numbers::pi * t), 5e-6) << t;
        EXPECT_NEAR(sin_turns(t), std::sin(2 * std::numbers::pi * t), 5e-6) << t;
    }
}

TEST(hash, floor_index_is_the_floor) {
    for (const float x : {-2.0f, -1.5f, -1.0f, -0.001f, 0.0f, 0.999f, 1.0f, 7.25f})
        EXPECT_EQ(floor_index(x), static_cast<int>(std::floor(x)));
    for (int i = -9; i < 9; ++i) EXPECT_EQ(lattice_index(i, 4), wrap_index(i, 4));
}

TEST(gradient_noise, vanishes_on_the_lattice_and_stays_in_range_with_mean_0) {
    for (int j = 0; j < 8; ++j) {
        for (int i = 0; i < 8; ++i)
            EXPECT_NEAR(gradient_noise({static_cast<float>(i) / 8, static_cast<float>(j) / 8}, 8, 8, 3), 0, 1e-6);
    }
    double sum = 0;
    double squares = 0;
    const int n = 256;
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const float x = gradient_noise({(static_cast<float>(i) + 0.5f) / n, (static_cast<float>(j) + 0.5f) / n}, 32, 32, 5);
            ASSERT_LE(std::abs(x), 1.0f);
            sum += x;
            squares += x * x;
        }
    }
    EXPECT_NEAR(sum / (n * n), 0, 0.02);
    EXPECT_NEAR(std::sqrt(squares / (n * n)), 0.35, 0.1);
}

TEST(gradient_noise, repeats_exactly_for_any_number_of_cells) {
    Dice dice(1);
    for (int k = 0; k < 500; ++k) {
        const Vec2f uv = dyadic(dice);
        EXPECT_NEAR(gradient_noise(uv, 7, 12, 9), gradient_noise(uv + Vec2f{1, 0}, 7, 12, 9), 1e-5);
        EXPECT_NEAR(gradient_noise(uv, 7, 12, 9), gradient_noise(uv - Vec2f{2, 1}, 7, 12, 9), 1e-5);
    }
}

TEST(fractal_noise, leaves_out_the_octaves_that_the_raster_cannot_hold) {
    const FractalSpec fine{.cells_u = 8, .cells_v = 8, .octaves = 6, .gain = 1};
    const FractalSpec coarse{.cells_u = 8, .cells_v = 8, .octaves = 1, .gain = 1};
    const FractalNoise wanted(fine, {.seed = 2, .sample_uv = 1.0f / 16}, 1);
    const FractalNoise kept(coarse, {.seed = 2, .sample_uv = 1.0f / 1024}, 1);
    const FractalNoise all(fine, {.seed = 2, .sample_uv = 1.0f / 1024}, 1);
    // At two texels a cell even the first octave has faded; at 1024 all are there.
    double small = 0;
    double whole = 0;
    for (int k = 0; k < 400; ++k) {
        const Vec2f uv{static_cast<float>(k) * 0.00713f, static_cast<float>(k) * 0.00291f};
        small += std::abs(wanted(uv));
        whole += std::abs(all(uv));
    }
    EXPECT_LT(small, 0.01 * whole);
    EXPECT_GT(std::abs(kept({0.31f, 0.77f})) + std::abs(kept({0.4f, 0.1f})), 0);
}

TEST(cellular, finds_the_two_nearest_points_that_a_wide_search_finds) {
    const CellularSpec spec{.cells_u = 6, .cells_v = 9, .jitter = 0.35f, .seed = 4};
    // Every point of the pattern, found as a place whose nearest distance is 0 by walking down the offsets.
    std::vector<Vec2f> points;
    for (int j = 0; j < spec.cells_v; ++j) {
        for (int i = 0; i < spec.cells_u; ++i) {
            const Vec2f uv{(static_cast<float>(i) + 0.5f) / 6, (static_cast<float>(j) + 0.5f) / 9};
            const Cellular c = cellular(uv, spec);
            points.push_back(uv - Vec2f{c.offset.x / 6, c.offset.y / 9});
        }
    }
    Dice dice(7);
    for (int k = 0; k < 300; ++k) {
        const Vec2f uv = dyadic(dice);
        float first = 1e9f;
        for (const Vec2f& p : points) {
            const Vec2f d = torus_offset(p, uv);
            first = std::min(first, length(Vec2f{d.x * 6, d.y * 9}));
        }
        const Cellular c = cellular(uv, spec);
        EXPECT_NEAR(c.nearest, first, 1e-4);
        EXPECT_GE(c.second, c.nearest);
        EXPECT_EQ(c.id, cellular(uv + Vec2f{1, 1}, spec).id);
    }
}

TEST(stone_packing, lays_stones_of_many_sizes_without_steps_on_any_of_them) {
    const StonePacking packing(0.105f, 0.022f, 11);
    float least = 1;
    float most = 0;
    for (const Stone& s : packing.stones()) {
        least = std::min(least, s.radius);
        most = std::max(most, s.radius);
    }
    EXPECT_GT(most, 3 * least);
    EXPECT_GT(packing.stones().size(), 40u);

    Dice dice(3);
    const float step = 1e-3f;
    for (int k = 0; k < 20000; ++k) {
        const Vec2f uv = dyadic(dice);
        const StonePlace here = packing.at(uv);
        const StonePlace there = packing.at(uv + Vec2f{step, 0});
        ASSERT_EQ(here.stone, packing.at(uv + Vec2f{1, 0}).stone);
        if (here.stone == there.stone) {
            ASSERT_LT(std::abs(here.inside - there.inside), 4 * step) << uv.x << ' ' << uv.y;
        } else {
            // Between two stones lies the border: both sides are near it.
            ASSERT_LT(here.inside, 6 * step);
            ASSERT_LT(there.inside, 6 * step);
        }
    }
}

TEST(carving, finds_the_same_grooves_as_looking_at_all_of_them) {
    const std::vector<Groove> word = inscription("RELIEVO", {0, 0}, 0.136f, {.wall = 0.5f, .slope = 0, .floor = 0.5f});
    const Carving carving(word);
    Dice dice(5);
    int inside = 0;
    for (int k = 0; k < 20000; ++k) {
        const Vec2f p = dyadic(dice) - Vec2f(0.5f);
        float nearest = Carving::reach;
        for (const Groove& g : word) nearest = std::min(nearest, groove_distance(g, p));
        const Cut cut = carving.at(p, 1e-4f, 0);
        ASSERT_EQ(cut.distance, nearest);
        ASSERT_NEAR(cut.depth, nearest < -1e-4f ? 0.5f : 0.0f, nearest < 0 && nearest > -1e-4f ? 0.5f : 1e-6f);
        if (nearest < 0) ++inside;
    }
    // Seven letters of a tenth's stroke in a seventh of the height.
    EXPECT_GT(inside, 20000 * 0.012);
    EXPECT_LT(inside, 20000 * 0.05);
}

TEST(carving, measures_a_plain_stroke_as_the_box_it_is) {
    const Groove g{.a = {-0.1f, 0}, .b = {0.1f, 0}, .width_a = 0.02f, .width_b = 0.02f};
    EXPECT_NEAR(groove_distance(g, {0, 0}), -0.02f, 1e-6);
    EXPECT_NEAR(groove_distance(g, {0, 0.05f}), 0.03f, 1e-6);
    EXPECT_NEAR(groove_distance(g, {0.12f, 0}), 0.02f, 1e-6);
}

TEST(wave_field, without_disorder_is_the_cosine_of_its_phase) {
    const auto phase = [](Vec2f uv) { return 20 * uv.x + 6 * uv.y; };
    const WaveField waves(24, phase, 0, 1);
    Dice dice(2);
    for (int k = 0; k < 300; ++k) {
        const Vec2f uv = dyadic(dice);
        EXPECT_NEAR(waves.at(uv), cos_turns(phase(uv)), 2e-3);
    }
}

TEST(distance, of_a_box_and_an_ellipse) {
    EXPECT_NEAR(box_distance({3, 4}, {0, 0}), 5, 1e-6);
    EXPECT_NEAR(box_distance({0, 0}, {2, 1}), -1, 1e-6);
    EXPECT_NEAR(ellipse_distance({2, 0}, {2, 1}), 0, 1e-6);
    EXPECT_NEAR(ellipse_distance({3, 0}, {2, 2}), 1, 1e-6);
}

}  // namespace
}  // namespace relievo
