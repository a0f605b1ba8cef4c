#include "measure/ssim.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace relievo {

namespace {

constexpr int radius = 5;
constexpr int window = 2 * radius + 1;

std::array<double, window> gaussian() {
    std::array<double, window> w{};
    double sum = 0;
    for (int k = 0; k < window; ++k) sum += w[static_cast<std::size_t>(k)] = std::exp(-(k - radius) * (k - radius) / (2 * 1.5 * 1.5));
    for (double& v : w) v /= sum;
    return w;
}

int reflected(int i, int size) {
    const int period = 2 * size;
    i = ((i % period) + period) % period;
    return i < size ? i : period - 1 - i;
}

// Windowed means of a row of the two pictures and their products. In double: variances are small differences of large numbers,
// and the constants that keep flat areas stable are small too.
struct Moments {
    std::vector<double> a, b, aa, bb, ab;
    explicit Moments(int width) {
        for (auto* v : {&a, &b, &aa, &bb, &ab}) v->assign(static_cast<std::size_t>(width), 0.0);
    }
};

void luma_row(const ImageF& image, int y, std::vector<double>& padded) {
    for (int x = -radius; x < image.width + radius; ++x) {
        const float* p = image.at(reflected(x, image.width), y);
        padded[static_cast<std::size_t>(x + radius)] =
            0.2126 * static_cast<double>(p[0]) + 0.7152 * static_cast<double>(p[1]) + 0.0722 * static_cast<double>(p[2]);
    }
}

}  // namespace

double ssim(const ImageF& display_picture, const ImageF& display_reference, int threads) {
    assert(!display_picture.empty() && display_picture.width == display_reference.width &&
           display_picture.height == display_reference.height);
    assert(display_picture.channels == 3 && display_reference.channels == 3);
    constexpr double c1 = 0.01 * 0.01;
    constexpr double c2 = 0.03 * 0.03;
    const auto weights = gaussian();
    const int width = display_picture.width;
    const int height = display_picture.height;
    const auto columns = static_cast<std::size_t>(width);

    std::vector<double> sums(static_cast<std::size_t>(height), 0.0);
    parallel_for(height, 48, threads, [&](int begin, int end) {
        std::vector<Moments> rows;
        std::vector<double> pa(columns + 2 * radius), pb(columns + 2 * radius);
        for (int y = begin - radius; y < end + radius; ++y) {
            Moments m(width);
            luma_row(display_picture, reflected(y, height), pa);
            luma_row(display_reference, reflected(y, height), pb);
            for (std::size_t k = 0; k < window; ++k) {
                const double w = weights[k];
                for (std::size_t x = 0; x < columns; ++x) {
                    const double a = pa[x + k];
                    const double b = pb[x + k];
                    m.a[x] += w * a;
                    m.b[x] += w * b;
                    m.aa[x] += w * (a * a);
                    m.bb[x] += w * (b * b);
                    m.ab[x] += w * (a * b);
                }
            }
            rows.push_back(std::move(m));
        }
        for (int y = begin; y < end; ++y) {
            Moments m(width);
            for (std::size_t k = 0; k < window; ++k) {
                const Moments& row = rows[static_cast<std::size_t>(y - begin) + k];
                const double w = weights[k];
                for (std::size_t x = 0; x < columns; ++x) {
                    m.a[x] += w * row.a[x];
                    m.b[x] += w * row.b[x];
                    m.aa[x] += w * row.aa[x];
                    m.bb[x] += w * row.bb[x];
                    m.ab[x] += w * row.ab[x];
                }
            }
            double sum = 0;
            for (std::size_t x = 0; x < columns; ++x) {
                const double variance_a = m.aa[x] - m.a[x] * m.a[x];
                const double variance_b = m.bb[x] - m.b[x] * m.b[x];
                const double covariance = m.ab[x] - m.a[x] * m.b[x];
                sum += (2 * m.a[x] * m.b[x] + c1) * (2 * covariance + c2) /
                       ((m.a[x] * m.a[x] + m.b[x] * m.b[x] + c1) * (variance_a + variance_b + c2));
            }
            sums[static_cast<std::size_t>(y)] = sum;
        }
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0) / (static_cast<double>(width) * height);
}

}  // namespace relievo
