// The exact reference against answers that can be written down, then against brute force.
#include "reference/cast.h"

#include <gtest/gtest.h>

#include <random>

using namespace relievo;

namespace {

ReferenceRay ray_over(Vec2d uv, Vec2d uv_per_height) { return {.uv = uv, .uv_per_height = uv_per_height}; }

// h = 0 left of the middle column, 1 from it on; texel 3 of 8 is the last low one.
HeightField step_field() {
    HeightField field(8, 8);
    for (int j = 0; j < 8; ++j)
        for (int i = 4; i < 8; ++i) field.texels(i, j) = 1;
    return field;
}

HeightField random_field(int width, int height, unsigned seed) {
    HeightField field(width, height);
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(0, 1);
    for (float& h : field.texels.texels) h = uniform(random);
    return field;
}

}  // namespace

TEST(reference_cast, flat_field_is_met_at_its_height) {
    const HeightField field(5, 3, 0.25f);
    const ReferenceHit hit = reference_cast(field, ray_over({0.3, 0.7}, {0.2, -0.1}));
    ASSERT_TRUE(hit.found);
    EXPECT_DOUBLE_EQ(hit.height, 0.25);
    EXPECT_DOUBLE_EQ(hit.uv.x, 0.3 - 0.75 * 0.2);
    EXPECT_DOUBLE_EQ(hit.uv.y, 0.7 + 0.75 * 0.1);
}

TEST(reference_cast, a_field_at_its_bounds_is_met_at_once_or_at_the_floor) {
    const ReferenceRay ray = ray_over({0.3, 0.7}, {0.2, -0.1});
    EXPECT_EQ(reference_cast(HeightField(4, 4, 1.0f), ray).height, 1);
    EXPECT_EQ(reference_cast(HeightField(4, 4, 0.0f), ray).height, 0);
}

TEST(reference_cast, vertical_rays_read_the_field) {
    const HeightField field = random_field(7, 4, 1);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> uniform(-3, 3);
    for (int k = 0; k < 1000; ++k) {
        const Vec2d uv{uniform(random), uniform(random)};
        const ReferenceHit hit = reference_cast(field, ray_over(uv, {0, 0}));
        ASSERT_TRUE(hit.found);
        EXPECT_NEAR(hit.height, field.sample(uv), 1e-14);
        EXPECT_EQ(hit.uv, uv);
    }
}

TEST(reference_cast, a_step_is_a_ramp_between_its_two_texels) {
    // The flank rises from 0 at texel centre 3 (u = 3.5/8) to 1 at texel centre 4: h = 8u - 3.5. The ray goes right as it descends:
    // u = 0.4 + (1 - z) 0.1, so that z = 8 (0.5 - 0.1 z) - 3.5 = 0.5 - 0.8 z.
    const ReferenceHit hit = reference_cast(step_field(), ray_over({0.4, 0.31}, {-0.1, 0}));
    ASSERT_TRUE(hit.found);
    EXPECT_NEAR(hit.height, 0.5 / 1.8, 1e-15);
    EXPECT_EQ(hit.cell, (Vec2i{3, 1}));
    // From the other side it lands on the plateau.
    EXPECT_EQ(reference_cast(step_field(), ray_over({0.7, 0.31}, {0.1, 0})).height, 1);
}

TEST(reference_cast, a_ramp_is_one_plane) {
    HeightField field(64, 2);
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 64; ++i) field.texels(i, j) = static_cast<float>(i) / 64;  // h = u - 0.5/64
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(0.3, 0.7);
    for (int k = 0; k < 1000; ++k) {
        const Vec2d uv{uniform(random), uniform(random)};
        const Vec2d r{(uniform(random) - 0.5), (uniform(random) - 0.5)};
        // z = uv.x - (1 - z) r.x - 0.5/64
        const double z = (uv.x - r.x - 0.5 / 64) / (1 - r.x);
        const ReferenceHit hit = reference_cast(field, ray_over(uv, r));
        EXPECT_NEAR(hit.height, z, 1e-14);
    }
}

TEST(reference_cast, a_wedge_hides_what_lies_behind_it) {
    // A ridge of height 0.5 at texel 8 of 32 over a floor of 0. A ray that clears the ridge by a hair lands on the floor behind
    // it; by a hair less, on its top.
    HeightField field(32, 1);
    field.texels(8, 0) = 0.5f;
    const double ridge = 8.5 / 32;
    const double reach = 0.2;  // UV per unit of height, to the right as it descends
    for (const double clear : {1e-9, -1e-9}) {
        const double over = 0.5 + clear;  // the ray's height at the ridge
        const ReferenceHit hit = reference_cast(field, ray_over({ridge - (1 - over) * reach, 0.2}, {-reach, 0}));
        if (clear > 0) {
            EXPECT_NEAR(hit.height, 0, 1e-12);
            EXPECT_NEAR(hit.uv.x, ridge + over * reach, 1e-12);
        } else {
            EXPECT_NEAR(hit.height, 0.5, 1e-8);
            EXPECT_NEAR(hit.uv.x, ridge, 1e-8);
        }
    }
}

TEST(reference_cast, a_saddle_cell_is_met_at_the_first_of_two_roots) {
    // One cell with h = u v ... on a 2x2 field every cell is a twisted patch: corners 0 0 0 1 give h = x y in cell (0,0).
    HeightField field(2, 2);
    field.texels(1, 1) = 1;
    // The ray follows the cell's diagonal x = y = p from p0: z = 1 - t, p = p0 + s t: p^2 = z.
    const double s = 0.5;
    const double p0 = 0.25;
    // (p0 + s t)^2 = 1 - t  ->  s^2 t^2 + (2 p0 s + 1) t + p0^2 - 1 = 0
    const double a = s * s;
    const double b = 2 * p0 * s + 1;
    const double c = p0 * p0 - 1;
    const double t = (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
    const double uv0 = (p0 + 0.5) / 2;
    const ReferenceHit hit = reference_cast(field, ray_over({uv0, uv0}, {-s / 2, -s / 2}));
    EXPECT_NEAR(hit.height, 1 - t, 1e-15);
    EXPECT_EQ(hit.cell, (Vec2i{0, 0}));
}

TEST(reference_cast, starts_on_walls_and_corners_and_follows_them) {
    const HeightField field = random_field(8, 8, 4);
    for (const Vec2d r : {Vec2d{0.3, 0}, Vec2d{-0.3, 0}, Vec2d{0, 0.3}, Vec2d{0, -0.3}, Vec2d{0.3, 0.3}, Vec2d{-0.3, 0.3}}) {
        // The start is the texel centre (3, 5); descending along r's opposite.
        const Vec2d start{3.5 / 8, 5.5 / 8};
        const ReferenceHit hit = reference_cast(field, ray_over(start, r));
        ASSERT_TRUE(hit.found);
        EXPECT_NEAR(field.sample(hit.uv), hit.height, 1e-13);
        // The same ray a hair beside the wall.
        const ReferenceHit beside = reference_cast(field, ray_over(start + Vec2d{1e-12, 1e-12}, r));
        EXPECT_NEAR(hit.height, beside.height, 1e-9);
    }
}

TEST(reference_cast, one_period_is_like_the_next) {
    const HeightField field = random_field(16, 8, 5);
    std::mt19937 random(6);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int k = 0; k < 2000; ++k) {
        const Vec2d uv{uniform(random), uniform(random)};
        const Vec2d r{uniform(random), uniform(random)};
        const ReferenceHit a = reference_cast(field, ray_over(uv, r));
        const ReferenceHit b = reference_cast(field, ray_over(uv + Vec2d{-1024, 4096}, r));
        EXPECT_NEAR(a.height, b.height, 1e-9);
        EXPECT_EQ(a.cell.x - 1024 * 16, b.cell.x);
    }
}

TEST(reference_cast, a_field_of_one_row_is_a_profile) {
    const HeightField row = random_field(13, 1, 7);
    const HeightField column = random_field(1, 13, 7);
    std::mt19937 random(8);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int k = 0; k < 1000; ++k) {
        const Vec2d uv{uniform(random), uniform(random)};
        const Vec2d r{uniform(random), uniform(random)};
        const double along = reference_cast(row, ray_over(uv, {r.x, 0})).height;
        EXPECT_NEAR(reference_cast(row, ray_over(uv, r)).height, along, 1e-13);
        EXPECT_NEAR(reference_cast(column, ray_over({uv.y, uv.x}, {r.y, r.x})).height, along, 1e-13);
    }
    EXPECT_EQ(reference_cast(HeightField(1, 1, 0.5f), ray_over({0.1, 0.2}, {0.3, 0.4})).height, 0.5);
}

TEST(reference_cast, zero_level_and_range_move_the_question_not_the_surface) {
    const HeightField field = random_field(16, 16, 9);
    const ReferenceRay carved{.uv = {0.3, 0.6}, .uv_per_height = {0.4, 0.3}};
    ReferenceRay raised = carved;
    raised.zero_level = 0;
    raised.uv = carved.uv - carved.uv_per_height;
    const ReferenceHit hit = reference_cast(field, carved);
    EXPECT_NEAR(reference_cast(field, raised).height, hit.height, 1e-14);
    ReferenceRay above = carved;
    above.z_end = hit.height + 1e-9;
    EXPECT_FALSE(reference_cast(field, above).found);
    above.z_end = hit.height - 1e-9;
    EXPECT_TRUE(reference_cast(field, above).found);
}

// The hit lies on the surface, and of a thousand points per texel before it none lies under the surface. In long double, from
// the definition of the bilinear surface alone.
TEST(reference_cast, nothing_lies_before_the_hit) {
    std::mt19937 random(10);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (const auto& [width, height] : {std::pair{8, 8}, {5, 7}, {16, 1}, {3, 16}}) {
        const HeightField field = random_field(width, height, static_cast<unsigned>(width));
        const auto at = [&](long double u, long double v) {
            const long double x = u * width - 0.5L;
            const long double y = v * height - 0.5L;
            const long double fx = x - std::floor(x);
            const long double fy = y - std::floor(y);
            const auto c = field.cell(static_cast<int>(std::floor(x)), static_cast<int>(std::floor(y)));
            return (c[0] * (1 - fx) + c[1] * fx) * (1 - fy) + (c[2] * (1 - fx) + c[3] * fx) * fy;
        };
        for (int k = 0; k < 300; ++k) {
            const Vec2d uv{uniform(random), uniform(random)};
            const Vec2d r{uniform(random), uniform(random)};
            const ReferenceHit hit = reference_cast(field, ray_over(uv, r));
            ASSERT_TRUE(hit.found);
            ASSERT_NEAR(static_cast<double>(at(hit.uv.x, hit.uv.y)), hit.height, 1e-12);
            const double texels = std::max(std::abs(r.x) * width, std::abs(r.y) * height) * (1 - hit.height);
            const int samples = 1 + static_cast<int>(1000 * texels);
            for (int s = 0; s < samples; ++s) {
                const long double z = 1 - (1 - static_cast<long double>(hit.height)) * s / samples;
                const long double gap = at(uv.x + (z - 1) * r.x, uv.y + (z - 1) * r.y) - z;
                ASSERT_LT(static_cast<double>(gap), 1e-12) << "height " << static_cast<double>(z) << " before " << hit.height;
            }
        }
    }
}
