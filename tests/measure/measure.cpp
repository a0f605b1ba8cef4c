#include "measure/measure.h"

#include "core/error.h"
#include "frames.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace relievo {
namespace {

using test::plain_frame;
using test::plain_rays;

const MeasureSettings settings{.texels_x = 64, .texels_y = 64};

std::string message_of(const Frame& p, const Frame& r, const RayField& rays) {
    try {
        measure(p, r, rays, settings);
    } catch (const Error& e) {
        return e.what();
    }
    return "no error";
}

TEST(Measure, PerfectPicture) {
    const Frame f = plain_frame(20, 10);
    const Measurement m = measure(f, f, plain_rays(20, 10, {-1, 0, 1}), settings);
    EXPECT_EQ(*m.missed_first_hit, 0);
    EXPECT_EQ(*m.flip, 0);
    EXPECT_EQ(*m.ssim, 1);
    EXPECT_EQ(m.psnr_db.reason, "identical pictures");
    EXPECT_EQ(m.fetches->mean, 4);
    EXPECT_FALSE(m.gpu_ms) << "time is no property of two pictures";
}

TEST(Measure, OnePixel) {
    const Frame reference = plain_frame(1, 1);
    Frame p = reference;
    p.colour(0, 0, 0) = 0.4f;
    p.hit_uv(0, 0, 0) += 0.25f;
    const Measurement m = measure(p, reference, plain_rays(1, 1, {-1, 0, 1}), settings);
    EXPECT_EQ(*m.missed_first_hit, 1);
    EXPECT_EQ(m.uv_error_texels->p50, 16);
    EXPECT_EQ(m.uv_error_texels->max, 16);
    EXPECT_GT(*m.flip, 0);
    EXPECT_LT(*m.ssim, 1);
    EXPECT_TRUE(std::isfinite(*m.psnr_db));
}

TEST(Measure, AllBackground) {
    const Frame sky(12, 8);
    const Measurement m = measure(sky, sky, RayField(12, 8), settings);
    EXPECT_EQ(m.missed_first_hit.reason, "the reference has no hit in any pixel");
    EXPECT_FALSE(m.uv_error_texels);
    EXPECT_EQ(*m.flip, 0) << "pictures are compared all the same";
    EXPECT_EQ(*m.ssim, 1);
}

TEST(Measure, SizesThatDifferAreAnError) {
    const std::string message = message_of(plain_frame(4, 4), plain_frame(4, 5), plain_rays(4, 4, {0, 0, 1}));
    EXPECT_NE(message.find("a picture of 4x4: the reference is 4x5 and the rays are 4x4"), std::string::npos) << message;
    EXPECT_NE(message_of(plain_frame(4, 4), plain_frame(4, 4), plain_rays(5, 4, {0, 0, 1})), "no error");
    EXPECT_NE(message_of(Frame(), Frame(), RayField()), "no error");
}

TEST(Measure, ColourThatIsNotANumberIsNamed) {
    const Frame good = plain_frame(6, 6);
    const RayField rays = plain_rays(6, 6, {0, 0, 1});
    Frame bad = good;
    bad.colour(4, 2, 1) = std::numeric_limits<float>::quiet_NaN();
    const std::string picture = message_of(bad, good, rays);
    EXPECT_NE(picture.find("the picture: pixel (4, 2) has NaN in channel 1"), std::string::npos) << picture;
    const std::string reference = message_of(good, bad, rays);
    EXPECT_NE(reference.find("the reference: pixel (4, 2) has NaN in channel 1"), std::string::npos) << reference;
}

TEST(Measure, SameDigitsForAnyNumberOfThreads) {
    std::mt19937 random(2);
    std::uniform_real_distribution<float> unit(0, 1);
    Frame a = plain_frame(90, 130), b = plain_frame(90, 130);
    for (Frame* f : {&a, &b}) {
        for (float& v : f->colour.texels) v = unit(random);
        for (float& v : f->hit_uv.texels) v = unit(random);
        for (float& v : f->hit_height.texels) v = unit(random);
        for (float& v : f->shadow.texels) v = unit(random);
        for (float& v : f->fetches.texels) v = std::floor(100 * unit(random));
    }
    const RayField rays = plain_rays(90, 130, {-1, 0.5, 1});
    MeasureSettings s = settings;
    s.threads = 1;
    const Measurement one = measure(a, b, rays, s);
    s.threads = 3;
    const Measurement three = measure(a, b, rays, s);
    EXPECT_EQ(*one.missed_first_hit, *three.missed_first_hit);
    EXPECT_EQ(one.uv_error_texels->p99, three.uv_error_texels->p99);
    EXPECT_EQ(one.height_error->p50, three.height_error->p50);
    EXPECT_EQ(*one.flip, *three.flip);
    EXPECT_EQ(*one.ssim, *three.ssim);
    EXPECT_EQ(*one.psnr_db, *three.psnr_db);
    EXPECT_EQ(one.fetches->mean, three.fetches->mean);
}

}  // namespace
}  // namespace relievo
