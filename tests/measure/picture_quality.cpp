// SSIM and PSNR: by hand where the answer is known, and against direct sums on random pictures.
#include "core/error.h"
#include "measure/display_values.h"
#include "pictures.h"
#include "measure/psnr.h"
#include "measure/ssim.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <utility>

namespace relievo {
namespace {

using test::painted;
using test::random_picture;
using test::uniform;

TEST(DisplayValues, FollowTheStandard) {
    EXPECT_EQ(srgb_encoded(0), 0);
    EXPECT_NEAR(srgb_encoded(1), 1, 1e-6);
    EXPECT_NEAR(srgb_encoded(0.5f), 0.735357f, 1e-5f);
    EXPECT_NEAR(srgb_encoded(0.001f), 0.01292f, 1e-7f);
    const ImageF shown = display_values(uniform(2, 1, {-1.0f, 4.0f, 0.5f}), "the picture");
    EXPECT_EQ(shown(0, 0, 0), 0);
    EXPECT_NEAR(shown(0, 0, 1), 1, 1e-6);
}

TEST(DisplayValues, PixelThatIsNotANumberIsNamed) {
    ImageF bad = uniform(9, 9, {0, 0, 0});
    bad(3, 5, 0) = std::numeric_limits<float>::quiet_NaN();
    try {
        display_values(bad, "the reference");
        FAIL() << "no error";
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("the reference: pixel (3, 5) has NaN in channel 0"), std::string::npos) << e.what();
    }
}

TEST(Psnr, KnownRatios) {
    const ImageF half = uniform(5, 4, {0.5f, 0.5f, 0.5f});
    EXPECT_NEAR(*psnr_db(uniform(5, 4, {0, 0, 0}), uniform(5, 4, {1, 1, 1})), 0, 1e-9);
    EXPECT_NEAR(*psnr_db(half, uniform(5, 4, {0.6f, 0.6f, 0.6f})), 20, 1e-5);
    // One channel of three off by a tenth: a third of the squares, 10 log10(3) more.
    EXPECT_NEAR(*psnr_db(half, uniform(5, 4, {0.5f, 0.6f, 0.5f})), 20 + 10 * std::log10(3.0), 1e-5);
}

TEST(Psnr, IdenticalPicturesHaveNoRatio) {
    const ImageF a = random_picture(8, 8, 1);
    const Measured<double> m = psnr_db(a, a);
    EXPECT_FALSE(m);
    EXPECT_EQ(m.reason, "identical pictures");
}

TEST(Psnr, DoesNotDependOnThreads) {
    const ImageF a = random_picture(70, 200, 1), b = random_picture(70, 200, 2);
    EXPECT_EQ(*psnr_db(a, b, 1), *psnr_db(a, b, 3));
}

// Straight from section III of the paper: one 11 x 11 window per pixel, deviations from the means summed in double.
double direct_ssim(const ImageF& a, const ImageF& b) {
    const auto luma = [](const ImageF& image, int x, int y) {
        const auto mirror = [](int i, int n) {
            while (i < 0 || i >= n) i = i < 0 ? -1 - i : 2 * n - 1 - i;
            return i;
        };
        const float* p = image.at(mirror(x, image.width), mirror(y, image.height));
        return 0.2126 * static_cast<double>(p[0]) + 0.7152 * static_cast<double>(p[1]) + 0.0722 * static_cast<double>(p[2]);
    };
    double weight[11][11], sum = 0;
    for (int j = 0; j < 11; ++j) {
        for (int i = 0; i < 11; ++i) sum += weight[j][i] = std::exp(-((i - 5) * (i - 5) + (j - 5) * (j - 5)) / (2 * 1.5 * 1.5));
    }
    double total = 0;
    for (int y = 0; y < a.height; ++y) {
        for (int x = 0; x < a.width; ++x) {
            double mean_a = 0, mean_b = 0, var_a = 0, var_b = 0, cov = 0;
            for (int j = 0; j < 11; ++j) {
                for (int i = 0; i < 11; ++i) {
                    mean_a += weight[j][i] / sum * luma(a, x + i - 5, y + j - 5);
                    mean_b += weight[j][i] / sum * luma(b, x + i - 5, y + j - 5);
                }
            }
            for (int j = 0; j < 11; ++j) {
                for (int i = 0; i < 11; ++i) {
                    const double da = luma(a, x + i - 5, y + j - 5) - mean_a, db = luma(b, x + i - 5, y + j - 5) - mean_b;
                    var_a += weight[j][i] / sum * da * da;
                    var_b += weight[j][i] / sum * db * db;
                    cov += weight[j][i] / sum * da * db;
                }
            }
            total += (2 * mean_a * mean_b + 1e-4) * (2 * cov + 9e-4) / ((mean_a * mean_a + mean_b * mean_b + 1e-4) * (var_a + var_b + 9e-4));
        }
    }
    return total / (a.width * a.height);
}

TEST(Ssim, IdenticalPicturesAreOne) {
    const ImageF a = random_picture(40, 30, 1);
    EXPECT_EQ(ssim(a, a), 1);
}

TEST(Ssim, UniformPicturesCompareByTheirMeans) {
    // Without variance only the luminance term is left: (2ab + C1) / (a^2 + b^2 + C1).
    const double expected = (2 * 0.2 * 0.6 + 1e-4) / (0.04 + 0.36 + 1e-4);
    EXPECT_NEAR(ssim(uniform(30, 20, {0.2f, 0.2f, 0.2f}), uniform(30, 20, {0.6f, 0.6f, 0.6f})), expected, 1e-6);
}

TEST(Ssim, InvertedPictureIsNegative) {
    const ImageF a = random_picture(40, 30, 1);
    ImageF inverted = a;
    for (float& v : inverted.texels) v = 1 - v;
    EXPECT_LT(ssim(a, inverted), -0.5);
}

TEST(Ssim, AgreesWithDirectSums) {
    const auto rings = [](float phase) {
        return painted(47, 33, [phase](int x, int y) {
            const auto fx = static_cast<float>(x - 20), fy = static_cast<float>(y - 15);
            return Vec3f{0.5f + 0.5f * std::sin(std::sqrt(fx * fx + fy * fy) + phase), 0.4f, 0.5f + 0.5f * std::sin(fx * 0.7f + phase)};
        });
    };
    EXPECT_NEAR(ssim(rings(0), rings(0.3f)), direct_ssim(rings(0), rings(0.3f)), 1e-9);
    for (const auto& [w, h] : {std::pair{47, 33}, std::pair{3, 9}, std::pair{1, 1}, std::pair{60, 2}, std::pair{12, 120}}) {
        const ImageF a = random_picture(w, h, 5), b = random_picture(w, h, 6);
        EXPECT_NEAR(ssim(a, b, 2), direct_ssim(a, b), 1e-9) << w << "x" << h;
    }
}

TEST(Ssim, DoesNotDependOnThreads) {
    const ImageF a = random_picture(70, 200, 1), b = random_picture(70, 200, 2);
    EXPECT_EQ(ssim(a, b, 1), ssim(a, b, 3));
}

}  // namespace
}  // namespace relievo
