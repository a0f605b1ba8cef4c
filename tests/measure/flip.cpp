#include "measure/flip.h"

#include "core/error.h"
#include "flip_direct.h"
#include "pictures.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <ostream>

namespace relievo {
namespace {

using test::painted;
using test::random_picture;
using test::uniform;

constexpr Vec3f black{0, 0, 0}, white{1, 1, 1};

TEST(Flip, IdenticalPicturesAreExactlyZero) {
    const ImageF picture = random_picture(61, 47, 3);
    const FlipResult r = flip(picture, picture);
    EXPECT_EQ(r.mean, 0);
    for (float e : r.error.texels) EXPECT_EQ(e, 0);
}

// Uniform pictures have no features, so the error is that of the two colours alone, worked out on paper:
// black to white is 100 apart in L*; green and blue are the farthest pair by definition.
TEST(Flip, KnownExtremes) {
    EXPECT_NEAR(flip(uniform(40, 30, {0, 1, 0}), uniform(40, 30, {0, 0, 1})).mean, 1, 1e-5);

    // Green (L* 87.735, a* -86.183, b* 83.179) and blue (32.297, 79.188, -107.860); Hunt's factor is L*/100.
    const double farthest = (87.735 - 32.297) + std::hypot(-86.183 * 0.87735 - 79.188 * 0.32297, 83.179 * 0.87735 + 107.860 * 0.32297);
    const double c_max = std::pow(farthest, 0.7);
    const double expected = 0.95 + 0.05 * (std::pow(100.0, 0.7) - 0.4 * c_max) / (0.6 * c_max);
    EXPECT_NEAR(flip(uniform(40, 30, black), uniform(40, 30, white)).mean, expected, 1e-4);
}

TEST(Flip, DoesNotDependOnOrder) {
    const ImageF a = random_picture(50, 20, 1), b = random_picture(50, 20, 2);
    EXPECT_EQ(flip(a, b).error.texels, flip(b, a).error.texels);
}

TEST(Flip, DoesNotDependOnThreads) {
    const ImageF a = random_picture(70, 200, 1), b = random_picture(70, 200, 2);
    const FlipResult one = flip(a, b, {.threads = 1});
    for (const int threads : {2, 3, 8}) {
        const FlipResult r = flip(a, b, {.threads = threads});
        EXPECT_EQ(r.mean, one.mean);
        EXPECT_EQ(r.error.texels, one.error.texels);
    }
}

TEST(Flip, BrighterThanTheDisplayIsClamped) {
    const ImageF a = random_picture(30, 30, 4);
    ImageF bright = a;
    ImageF clipped = a;
    for (std::size_t i = 0; i < a.texels.size(); i += 5) {
        bright.texels[i] = 3 + a.texels[i];
        clipped.texels[i] = 1;
    }
    EXPECT_EQ(flip(bright, clipped).mean, 0);
}

struct Pair {
    const char* name;
    ImageF a, b;
    double pixels_per_degree = 67;
};

void PrintTo(const Pair& pair, std::ostream* out) { *out << pair.name; }

class FlipAgainstDirect : public testing::TestWithParam<Pair> {};

TEST_P(FlipAgainstDirect, AgreesPerPixel) {
    const Pair& pair = GetParam();
    const FlipResult ours = flip(pair.a, pair.b, {.pixels_per_degree = pair.pixels_per_degree});
    const std::vector<double> direct = test::DirectFlip(pair.pixels_per_degree)(pair.a, pair.b);
    ASSERT_EQ(ours.error.texels.size(), direct.size());
    double worst = 0;
    for (std::size_t i = 0; i < direct.size(); ++i) worst = std::max(worst, std::abs(static_cast<double>(ours.error.texels[i]) - direct[i]));
    EXPECT_LE(worst, 1e-3);
    EXPECT_NEAR(ours.mean, std::accumulate(direct.begin(), direct.end(), 0.0) / static_cast<double>(direct.size()), 1e-4);
}

Vec3f checker(int x, int y, int size) { return ((x / size + y / size) & 1) != 0 ? white : black; }

std::vector<Pair> pairs() {
    const ImageF noise = random_picture(53, 41, 11);
    const auto stripes = [](int x, int) { return (x / 3) % 2 ? Vec3f{0.9f, 0.2f, 0.1f} : Vec3f{0.1f, 0.3f, 0.8f}; };
    const auto disc = [](float cx) {
        return [cx](int x, int y) {
            const float dx = static_cast<float>(x) - cx, dy = static_cast<float>(y) - 20;
            return dx * dx + dy * dy < 80 ? Vec3f{0.7f, 0.5f, 0.2f} : Vec3f{0.05f, 0.06f, 0.1f};
        };
    };
    const auto ramp = [](int x, int y) { return Vec3f{static_cast<float>(x) / 52, static_cast<float>(y) / 40, 0.3f}; };
    ImageF speck = painted(53, 41, ramp);
    speck(26, 20, 1) = 1;
    return {
        {"Random", noise, random_picture(53, 41, 12)},
        {"RandomFewPixelsPerDegree", noise, random_picture(53, 41, 12), 20},
        {"RandomManyPixelsPerDegree", random_picture(23, 21, 5), random_picture(23, 21, 6), 150},
        {"OnePixelPerDegree", random_picture(23, 21, 5), random_picture(23, 21, 6), 1},
        {"Checkers", painted(53, 41, [](int x, int y) { return checker(x, y, 4); }),
         painted(53, 41, [](int x, int y) { return checker(x + 1, y, 4); })},
        {"CheckerAgainstBlack", painted(53, 41, [](int x, int y) { return checker(x, y, 1); }), uniform(53, 41, black)},
        {"StripesTurned", painted(53, 41, stripes), painted(53, 41, [&](int x, int y) { return stripes(y, x); })},
        {"DiscMoved", painted(53, 41, disc(24)), painted(53, 41, disc(26.5f))},
        {"OneSpeck", painted(53, 41, ramp), speck},
        {"NarrowerThanTheKernels", random_picture(3, 50, 21), random_picture(3, 50, 22)},
        {"OneRow", random_picture(40, 1, 31), random_picture(40, 1, 32)},
        {"OnePixel", uniform(1, 1, {0.2f, 0.9f, 0.4f}), uniform(1, 1, {0.7f, 0.1f, 0.4f})},
    };
}

INSTANTIATE_TEST_SUITE_P(Pictures, FlipAgainstDirect, testing::ValuesIn(pairs()), [](const auto& test) { return test.param.name; });

TEST(Flip, PixelThatIsNotANumberIsNamed) {
    const ImageF good = random_picture(30, 90, 1);
    ImageF bad = good;
    bad(29, 80, 1) = std::numeric_limits<float>::quiet_NaN();
    bad(12, 34, 2) = std::numeric_limits<float>::infinity();
    try {
        flip(bad, good);
        FAIL() << "no error";
    } catch (const Error& e) {
        const std::string message = e.what();
        EXPECT_NE(message.find("the picture"), std::string::npos) << message;
        EXPECT_NE(message.find("pixel (12, 34) has an infinite value in channel 2"), std::string::npos) << message;
    }
    EXPECT_THROW(flip(good, bad), Error);
}

TEST(Flip, ImpossibleViewingDistanceIsRefused) {
    const ImageF a = uniform(4, 4, white);
    for (const double ppd : {0.0, -67.0, 0.5, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        EXPECT_THROW(flip(a, a, {.pixels_per_degree = ppd}), Error) << ppd;
    }
}

}  // namespace
}  // namespace relievo
