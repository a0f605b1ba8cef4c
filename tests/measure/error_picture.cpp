#include "measure/error_picture.h"

#include "frames.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace relievo {
namespace {

using test::plain_frame;
using test::plain_rays;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

Rgb8 pixel(const Image8& image, int x, int y) { return {image(x, y, 0), image(x, y, 1), image(x, y, 2)}; }

Rgb8 shown(float error) {
    const ImageF plane(1, 1, 1, error);
    return pixel(hit_error_picture(plane), 0, 0);
}

// Relative luminance of an sRGB colour.
double luminance(Rgb8 c) {
    const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(c[0] / 255.0) + 0.7152 * linear(c[1] / 255.0) + 0.0722 * linear(c[2] / 255.0);
}

// What a browser would paint at `position` of the bar.
Rgb8 painted_bar(const Legend& legend, double position) {
    const LegendStop* before = &legend.stops.front();
    for (const LegendStop& stop : legend.stops) {
        if (stop.position > position) {
            const double t = (position - before->position) / (stop.position - before->position);
            Rgb8 out;
            for (std::size_t c = 0; c < 3; ++c) out[c] = static_cast<std::uint8_t>(std::lround(before->colour[c] * (1 - t) + stop.colour[c] * t));
            return out;
        }
        before = &stop;
    }
    return before->colour;
}

void expect_near(Rgb8 a, Rgb8 b, int tolerance, const std::string& what) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << what << ", channel " << c;
}

TEST(HitError, IsSignedAlongTheRayAndMarksWhatHasNoError) {
    Frame reference = plain_frame(6, 1);
    RayField rays = plain_rays(6, 1, {-1, 0, 1});
    Frame p = reference;
    p.hit_uv(1, 0, 0) += 4.0f / 64;
    p.hit_uv(2, 0, 0) -= 4.0f / 64;
    p.coverage(3, 0) = test::no_hit;
    rays.coverage(4, 0) = test::background;
    reference.coverage(5, 0) = test::no_hit;
    const ImageF e = hit_error_texels(p, reference, rays, {64, 64});
    EXPECT_EQ(e(0, 0), 0);
    EXPECT_FLOAT_EQ(e(1, 0), 4);
    EXPECT_FLOAT_EQ(e(2, 0), -4);
    EXPECT_EQ(e(3, 0), infinity);
    EXPECT_TRUE(std::isnan(e(4, 0)));
    EXPECT_TRUE(std::isnan(e(5, 0)));
}

TEST(HitErrorPicture, HuesTellLateFromEarlyAndMarksStandApart) {
    for (const float size : {0.6f, 2.0f, 9.0f, 40.0f, 1000.0f}) {
        const Rgb8 late = shown(size), early = shown(-size);
        EXPECT_GT(late[0], late[2] + 60) << "late is warm at " << size;
        EXPECT_GT(early[2], early[0] + 60) << "early is cool at " << size;
        EXPECT_NEAR(std::cbrt(luminance(late)), std::cbrt(luminance(early)), 0.08) << "the same error has the same lightness, " << size;
    }
    EXPECT_EQ(shown(0), shown(0.5f));
    EXPECT_EQ(shown(0), shown(-0.5f));
    EXPECT_LT(luminance(shown(0)), 0.01);
    EXPECT_EQ(shown(infinity), (Rgb8{255, 255, 255}));
    const Rgb8 background = shown(nan);
    EXPECT_GT(luminance(background), 5 * luminance(shown(0)));
    EXPECT_EQ(shown(64), shown(1e30f));
}

TEST(HitErrorPicture, LargerErrorsAreLighter) {
    for (const float sign : {1.0f, -1.0f}) {
        double before = luminance(shown(0));
        for (float size = 0.51f; size < 64; size *= 1.1f) {
            const double now = luminance(shown(sign * size));
            EXPECT_GT(now, before) << sign * size;
            before = now;
        }
    }
}

TEST(HitErrorPicture, LegendPaintsTheSameScale) {
    const Legend legend = hit_error_legend();
    double previous = 0, previous_value = -1e9;
    for (const LegendStop& stop : legend.stops) {
        EXPECT_GE(stop.position, previous);
        EXPECT_GE(stop.value, previous_value);
        previous = stop.position;
        previous_value = stop.value;
    }
    EXPECT_EQ(legend.stops.front().position, 0);
    EXPECT_EQ(legend.stops.back().position, 1);
    // Fifteen octaves wide: seven early, one right, seven late.
    for (double octave = 0.05; octave < 7; octave += 0.13) {
        const auto size = static_cast<float>(0.5 * std::exp2(octave));
        expect_near(painted_bar(legend, (8 + octave) / 15), shown(size), 1, "late " + std::to_string(size));
        expect_near(painted_bar(legend, (7 - octave) / 15), shown(-size), 1, "early " + std::to_string(size));
    }
    expect_near(painted_bar(legend, 0.5), shown(0), 0, "right");
    EXPECT_EQ(legend.keys.at(0).colour, shown(infinity));
    EXPECT_EQ(legend.keys.at(1).colour, shown(nan));
}

TEST(FetchesPicture, IsOneFixedScaleFromDarkToLight) {
    Frame f = plain_frame(300, 1);
    for (int x = 0; x < 300; ++x) f.fetches(x, 0) = static_cast<float>(x) * 0.5f;
    f.coverage(298, 0) = test::no_hit;
    f.coverage(299, 0) = test::background;
    const Image8 image = fetches_picture(f, 2);
    double before = -1;
    for (int x = 0; x <= 256; ++x) {
        const double now = luminance(pixel(image, x, 0));
        EXPECT_GE(now, before) << x;
        before = now;
    }
    EXPECT_EQ(pixel(image, 256, 0), pixel(image, 297, 0)) << "from 128 fetches on the scale ends";
    EXPECT_EQ(pixel(image, 298, 0), (Rgb8{255, 255, 255}));

    const Legend legend = fetches_legend();
    for (const LegendStop& stop : legend.stops) {
        EXPECT_EQ(pixel(image, static_cast<int>(stop.value * 2), 0), stop.colour) << stop.value;
    }
    EXPECT_EQ(pixel(image, 299, 0), legend.keys.at(1).colour);
}

}  // namespace
}  // namespace relievo
