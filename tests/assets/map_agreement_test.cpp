#include "assets/map_agreement.h"

#include "core/wrap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace relievo::test {

namespace {

constexpr double tau = 2 * std::numbers::pi;

// Sums of waves: analytic heights in [0,1] and slopes at any point.
struct Waves {
    struct Wave {
        int u, v;
        double phase, amplitude;
    };
    std::vector<Wave> waves;

    explicit Waves(unsigned seed, int highest = 9) {
        std::mt19937 random(seed);
        for (int k = 0; k < 12; ++k) {
            const auto pick = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(2 * n + 1)) - n; };
            waves.push_back({pick(highest), pick(highest), static_cast<double>(random() % 1000) / 1000 * tau, 0.5 / 12});
        }
    }
    double height(double u, double v) const {
        double h = 0.5;
        for (const Wave& w : waves) h += w.amplitude * std::cos(tau * (w.u * u + w.v * v) + w.phase);
        return h;
    }
    // d height / du or dv
    double slope(double u, double v, bool along_v) const {
        double s = 0;
        for (const Wave& w : waves) s -= w.amplitude * tau * (along_v ? w.v : w.u) * std::sin(tau * (w.u * u + w.v * v) + w.phase);
        return s;
    }
};

constexpr double scale = 0.04;

HeightField heights(const Waves& waves, int width, int height, bool inverted) {
    HeightField field(width, height);
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
            const double h = waves.height((i + 0.5) / width, (j + 0.5) / height);
            field.texels(i, j) = static_cast<float>(inverted ? 1 - h : h);
        }
    return field;
}

ImageF normals(const Waves& waves, int width, int height, bool green_down) {
    ImageF image(width, height, 3);
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
            const double u = (i + 0.5) / width, v = (j + 0.5) / height;
            const double x = -scale * waves.slope(u, v, false), y = -scale * waves.slope(u, v, true);
            const double n = std::sqrt(x * x + y * y + 1);
            image(i, j, 0) = static_cast<float>(x / n);
            image(i, j, 1) = static_cast<float>((green_down ? -y : y) / n);
            image(i, j, 2) = static_cast<float>(1 / n);
        }
    return image;
}

// What happens to maps on their way to us.
void add_noise(ImageF& image, float sigma, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> noise(0, sigma);
    for (float& x : image.texels) x += noise(random);
}

void quantise(ImageF& image, float steps) {
    for (float& x : image.texels) x = std::round(x * steps) / steps;
}

ImageF blurred(const ImageF& image, int radius) {
    ImageF out(image.width, image.height, image.channels);
    for (int j = 0; j < image.height; ++j)
        for (int i = 0; i < image.width; ++i)
            for (int c = 0; c < image.channels; ++c) {
                float sum = 0;
                for (int dj = -radius; dj <= radius; ++dj)
                    for (int di = -radius; di <= radius; ++di)
                        sum += image(wrap_index(i + di, image.width), wrap_index(j + dj, image.height), c);
                out(i, j, c) = sum / static_cast<float>((2 * radius + 1) * (2 * radius + 1));
            }
    return out;
}

void expect_reading(const HeightField& height, const ImageF& normal, bool inverted, bool green_down, const char* what) {
    const MapAgreement a = compare_maps(height, normal);
    const MapReading r = read_agreement(a);
    EXPECT_TRUE(r.polarity_decided && r.green_decided) << what << ": " << a.x << " " << a.y;
    EXPECT_EQ(r.inverted, inverted) << what << ": " << a.x << " " << a.y;
    EXPECT_EQ(r.green_down, green_down) << what << ": " << a.x << " " << a.y;
}

}  // namespace

TEST(MapAgreement, PerfectMapsAgreePerfectlyAndGiveTheAmplitude) {
    const Waves waves(1);
    const MapAgreement a = compare_maps(heights(waves, 256, 256, false), normals(waves, 256, 256, false));
    EXPECT_GT(a.x, 0.999);
    EXPECT_GT(a.y, 0.999);
    EXPECT_NEAR(a.height_scale, scale, 0.02 * scale);
}

TEST(MapAgreement, AllFourReadingsThroughAllDamage) {
    for (const bool inverted : {false, true})
        for (const bool green_down : {false, true})
            for (const unsigned seed : {1u, 2u, 3u}) {
                const Waves waves(seed);
                const HeightField h = heights(waves, 128, 128, inverted);
                const ImageF n = normals(waves, 128, 128, green_down);
                expect_reading(h, n, inverted, green_down, "clean");

                HeightField noisy = h;
                ImageF noisy_normals = n;
                add_noise(noisy.texels, 0.05f, seed);
                add_noise(noisy_normals, 0.15f, seed + 100);
                expect_reading(noisy, noisy_normals, inverted, green_down, "noise");

                HeightField coarse = h;
                ImageF coarse_normals = n;
                quantise(coarse.texels, 15);
                quantise(coarse_normals, 31);
                expect_reading(coarse, coarse_normals, inverted, green_down, "few grey levels");

                HeightField soft = h;
                soft.texels = blurred(h.texels, 4);
                expect_reading(soft, n, inverted, green_down, "blurred height");
                expect_reading(h, blurred(n, 4), inverted, green_down, "blurred and shortened normals");

                expect_reading(h, normals(waves, 300, 200, green_down), inverted, green_down, "different sizes");
                expect_reading(heights(waves, 64, 512, inverted), n, inverted, green_down, "different shapes");
                expect_reading(heights(waves, 32, 32, inverted), normals(waves, 32, 32, green_down), inverted, green_down, "small");
            }
}

TEST(MapAgreement, GrooveInOneDirectionDecidesWhatItCan) {
    // Slope along u only: polarity is told, green is not.
    Waves grooves(5);
    for (auto& w : grooves.waves) w.v = 0;
    MapReading r = read_agreement(compare_maps(heights(grooves, 128, 128, true), normals(grooves, 128, 128, false)));
    EXPECT_TRUE(r.polarity_decided && r.inverted);
    EXPECT_FALSE(r.green_decided);
    // Slope along v only: inverted or green down cannot be told apart; green carries the sign.
    for (auto& w : grooves.waves) w.v = w.u, w.u = 0;
    r = read_agreement(compare_maps(heights(grooves, 128, 128, false), normals(grooves, 128, 128, true)));
    EXPECT_FALSE(r.polarity_decided);
    EXPECT_TRUE(r.green_decided && r.green_down);
}

TEST(MapAgreement, UnrelatedFlatAndTinyMapsLeaveItUndecided) {
    for (unsigned seed = 10; seed < 40; seed += 2) {
        const MapAgreement a = compare_maps(heights(Waves(seed), 128, 128, false), normals(Waves(seed + 1), 128, 128, false));
        const MapReading r = read_agreement(a);
        EXPECT_FALSE(r.polarity_decided || r.green_decided) << seed << ": " << a.x << " " << a.y;
    }
    const Waves waves(1);
    ImageF flat(64, 64, 3);
    for (std::size_t i = 2; i < flat.texels.size(); i += 3) flat.texels[i] = 1;
    for (const MapAgreement& a :
         {compare_maps(heights(waves, 64, 64, false), flat), compare_maps(HeightField(64, 64, 0.5f), normals(waves, 64, 64, false)),
          compare_maps(HeightField(1, 1, 0.5f), normals(waves, 64, 64, false)),
          compare_maps(heights(waves, 1, 512, false), normals(waves, 512, 1, false))}) {
        EXPECT_EQ(a.x, 0);
        EXPECT_EQ(a.y, 0);
        EXPECT_FALSE(read_agreement(a).polarity_decided || read_agreement(a).green_decided);
    }
}

}  // namespace relievo::test
