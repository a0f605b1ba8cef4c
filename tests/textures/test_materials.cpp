// What each material is there to show, measured.
#include "textures/curves.h"
#include "textures/hash.h"
#include "textures/materials.h"
#include "textures/procedural.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace relievo {
namespace {

struct Named {
    const char* id;
    SurfaceFunction (*surface)(const Detail&);

    friend void PrintTo(const Named& named, std::ostream* out) { *out << named.id; }
};

class EachSurface : public testing::TestWithParam<Named> {};

TEST_P(EachSurface, repeats_after_one_unit_of_uv) {
    const SurfaceFunction surface = GetParam().surface({.seed = 6, .sample_uv = 1.0f / 256});
    Dice dice(21);
    int differ = 0;
    const int places = 3000;
    for (int k = 0; k < places; ++k) {
        // Multiples of 1/4096, to which a period is added without rounding; a quarter of them at the seam.
        Vec2f uv{static_cast<float>(dice.bits() >> 20) / 4096, static_cast<float>(dice.bits() >> 20) / 4096};
        if (k % 4 == 0) uv.x = static_cast<float>(k % 3) / 4096;
        const SurfacePoint here = surface(uv);
        for (const Vec2f period : {Vec2f{1, 0}, Vec2f{0, 1}, Vec2f{-1, -1}}) {
            const SurfacePoint there = surface(uv + period);
            if (std::abs(here.height - there.height) > 2e-3f || length(here.colour - there.colour) > 2e-2f) ++differ;
        }
    }
    // A place on the very line between two stones may fall to either.
    EXPECT_LE(differ, places / 500);
}

TEST_P(EachSurface, shows_no_seam_in_its_map) {
    const Material m = procedural_material(GetParam().id, 256, 4, 2);
    const HeightField& h = m.height;
    const auto step = [&](int i) {
        double sum = 0;
        for (int j = 0; j < h.height(); ++j)
            sum += std::abs(h.wrapped(i, j) - h.wrapped(i + 1, j)) + std::abs(h.wrapped(j, i) - h.wrapped(j, i + 1));
        return sum;
    };
    double worst = 0;
    for (int i = 1; i + 2 < h.width(); ++i) worst = std::max(worst, step(i));
    EXPECT_LE(step(h.width() - 1), 1.05 * worst);
}

TEST_P(EachSurface, looks_alike_in_any_size) {
    const Material large = procedural_material(GetParam().id, 512, 2, 2);
    const Material small = procedural_material(GetParam().id, 128, 2, 2);
    double height = 0;
    double colour = 0;
    for (int j = 0; j < 128; ++j) {
        for (int i = 0; i < 128; ++i) {
            double h = 0;
            double c = 0;
            for (int k = 0; k < 16; ++k) {
                h += large.height.texels(4 * i + k % 4, 4 * j + k / 4) / 16;
                c += (*large.colour)(4 * i + k % 4, 4 * j + k / 4, 1) / 16.0;
            }
            height += std::abs(h - small.height.texels(i, j));
            colour += std::abs(c - (*small.colour)(i, j, 1));
        }
    }
    EXPECT_LT(height / (128 * 128), 0.03);
    EXPECT_LT(colour / (128 * 128), 10.0);
}

TEST_P(EachSurface, has_the_colours_of_a_surface_not_of_a_light) {
    const Material m = procedural_material(GetParam().id, 256, 4, 2);
    const Image8& c = *m.colour;
    double luminance = 0;
    int clipped = 0;
    for (int j = 0; j < 256; ++j) {
        for (int i = 0; i < 256; ++i) {
            luminance += (0.2126 * c(i, j, 0) + 0.7152 * c(i, j, 1) + 0.0722 * c(i, j, 2)) / (255.0 * 256 * 256);
            for (int k = 0; k < 3; ++k) clipped += c(i, j, k) == 255 || c(i, j, k) == 0;
            ASSERT_EQ(c(i, j, 3), 255);
        }
    }
    EXPECT_EQ(clipped, 0);
    EXPECT_GT(luminance, 0.15);
    EXPECT_LT(luminance, 0.80);
}

INSTANTIATE_TEST_SUITE_P(textures, EachSurface,
                         testing::Values(Named{"bricks", bricks}, Named{"cobbles", cobbles}, Named{"spikes", spikes},
                                         Named{"engraving", engraving}, Named{"dunes", dunes}),
                         [](const auto& surface) { return std::string(surface.param.id); });

double share_between(const HeightField& h, float low, float high) {
    const auto count = std::ranges::count_if(h.texels.texels, [&](float x) { return x >= low && x < high; });
    return static_cast<double>(count) / static_cast<double>(h.texels.texels.size());
}

// Largest steepness (rise over run) of each texel, at a height_scale, sorted.
std::vector<double> slopes(const HeightField& h, double height_scale) {
    std::vector<double> all;
    for (int j = 0; j < h.height(); ++j) {
        for (int i = 0; i < h.width(); ++i) {
            const double du = (h.wrapped(i + 1, j) - h.wrapped(i, j)) * h.width();
            const double dv = (h.wrapped(i, j + 1) - h.wrapped(i, j)) * h.height();
            all.push_back(height_scale * std::sqrt(du * du + dv * dv));
        }
    }
    std::ranges::sort(all);
    return all;
}

TEST(bricks, have_flat_joints_and_faces_with_little_between) {
    const Material m = procedural_material("bricks", 512, 1, 2);
    EXPECT_GT(share_between(m.height, 0, 0.32f), 0.15);  // joints
    EXPECT_LT(share_between(m.height, 0, 0.32f), 0.35);
    EXPECT_GT(share_between(m.height, 0.65f, 1.1f), 0.55);  // faces
    EXPECT_LT(share_between(m.height, 0.32f, 0.6f), 0.12);  // walls: hardly any area
}

TEST(spikes, are_thinner_from_half_their_height_than_a_64th_of_a_descent_at_30_degrees) {
    const int size = 1024;
    const Material m = procedural_material("spikes", size, 1, 2);
    const double step = 0.12 / std::tan(30 * 3.14159265358979 / 180) / 64;
    int found = 0;
    double widest = 0;
    for (int j = 0; j < size; ++j) {
        for (int i = 0; i < size; ++i) {
            if (m.height.wrapped(i, j) < 0.5f || m.height.wrapped(i - 1, j) >= 0.5f) continue;
            // Width of the section through height 0.5 along the row, between the interpolated crossings.
            const float before = m.height.wrapped(i - 1, j);
            double width = (m.height.wrapped(i, j) - 0.5) / (m.height.wrapped(i, j) - before);
            int k = i;
            while (m.height.wrapped(k + 1, j) >= 0.5f) ++k;
            width += k - i + (m.height.wrapped(k, j) - 0.5) / (m.height.wrapped(k, j) - m.height.wrapped(k + 1, j));
            widest = std::max(widest, width / size);
            ++found;
        }
    }
    EXPECT_GT(found, 200);
    EXPECT_LT(widest, step);
    EXPECT_GT(widest, 0.4 * step);
}

TEST(spikes, are_missed_by_equal_steps) {
    const Material m = procedural_material("spikes", 1024, 1, 2);
    const auto first_hit = [&](Vec2d uv, Vec2d fall, int steps) {
        for (int k = 1; k <= steps; ++k) {
            const double t = static_cast<double>(k) / steps;
            if (m.height.sample(uv + fall * t) >= 1 - t) return t;
        }
        return 1.0;
    };
    const double reach = 0.12 / std::tan(30 * 3.14159265358979 / 180);
    const Vec2d fall{0.6 * reach, 0.8 * reach};
    Dice dice(9);
    int on_nails = 0;
    int missed = 0;
    for (int k = 0; k < 1200; ++k) {
        const Vec2d uv{dice.roll(), dice.roll()};
        const double truth = first_hit(uv, fall, 2048);
        if (truth > 0.8) continue;
        ++on_nails;
        if (first_hit(uv, fall, 64) > truth + 1.5 / 64) ++missed;
    }
    EXPECT_GT(on_nails, 80);
    EXPECT_GT(missed, 0.2 * on_nails) << "of " << on_nails;
}

TEST(cobbles, stand_apart_with_sand_between) {
    const Material m = procedural_material("cobbles", 512, 1, 2);
    EXPECT_GT(share_between(m.height, 0, 0.3f), 0.12);
    EXPECT_GT(share_between(m.height, 0.45f, 1.1f), 0.35);
}

TEST(engraving, has_near_sheer_walls_and_an_even_face) {
    const Material m = procedural_material("engraving", 1024, 1, 2);
    const std::vector<double> all = slopes(m.height, 0.04);
    EXPECT_GT(all.back(), std::tan(80 * 3.14159265358979 / 180));
    EXPECT_LT(all[all.size() / 2], std::tan(25 * 3.14159265358979 / 180));
    EXPECT_GT(share_between(m.height, 0.85f, 1.1f), 0.5);
    EXPECT_GT(share_between(m.height, 0, 0.6f), 0.05);
}

TEST(dunes, are_nowhere_steep_and_lean_downwind) {
    const Material m = procedural_material("dunes", 512, 1, 2);
    const std::vector<double> all = slopes(m.height, 0.14);
    EXPECT_LT(all[all.size() * 98 / 100], std::tan(42 * 3.14159265358979 / 180));
    // Rising ground is wider than falling ground, because the lee is steeper. Ripples are averaged away.
    int rising = 0;
    int falling = 0;
    for (int j = 0; j < 512; j += 8) {
        for (int i = 0; i < 512; i += 8) {
            double rise = 0;
            for (int k = 0; k < 24; ++k) rise += m.height.wrapped(i + 24 + k, j) - m.height.wrapped(i + k, j);
            ++(rise > 0 ? rising : falling);
        }
    }
    EXPECT_GT(rising, 1.15 * falling);
}

}  // namespace
}  // namespace relievo
