#include "assets/map_agreement.h"

#include "core/wrap.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace relievo {

namespace {

// Maps larger than this are compared at this size: what tells the signs apart is larger than a texel.
constexpr int largest_compared = 1024;

// Below 24 x 24 texels even unrelated maps agree by chance.
constexpr int smallest_compared = 24;

// The stretch of source texels under each target texel, with the share each has in its mean.
struct Span {
    int begin = 0;
    std::vector<float> weights;
};

std::vector<Span> spans_of(int from, int to) {
    std::vector<Span> spans(static_cast<std::size_t>(to));
    for (int i = 0; i < to; ++i) {
        const double a = static_cast<double>(i) * from / to;
        const double b = static_cast<double>(i + 1) * from / to;
        Span& span = spans[static_cast<std::size_t>(i)];
        span.begin = static_cast<int>(a);
        for (int k = span.begin; k < b && k < from; ++k)
            span.weights.push_back(static_cast<float>((std::min<double>(b, k + 1) - std::max<double>(a, k)) / (b - a)));
    }
    return spans;
}

// Mean over the area of each target texel; only ever downwards.
ImageF shrink(const ImageF& image, int width, int height) {
    assert(width <= image.width && height <= image.height);
    if (width == image.width && height == image.height) return image;
    const std::vector<Span> columns = spans_of(image.width, width);
    const std::vector<Span> rows = spans_of(image.height, height);
    const auto channels = static_cast<std::size_t>(image.channels);
    ImageF out(width, height, image.channels);
    std::vector<float> row(static_cast<std::size_t>(image.width) * channels);
    for (int j = 0; j < height; ++j) {
        std::fill(row.begin(), row.end(), 0.0f);
        const Span& span = rows[static_cast<std::size_t>(j)];
        for (std::size_t k = 0; k < span.weights.size(); ++k) {
            const float* from = image.at(0, span.begin + static_cast<int>(k));
            for (std::size_t i = 0; i < row.size(); ++i) row[i] += span.weights[k] * from[i];
        }
        float* to = out.at(0, j);
        for (const Span& column : columns) {
            const float* from = &row[static_cast<std::size_t>(column.begin) * channels];
            for (std::size_t c = 0; c < channels; ++c) {
                float sum = 0;
                for (std::size_t k = 0; k < column.weights.size(); ++k) sum += column.weights[k] * from[k * channels + c];
                *to++ = sum;
            }
        }
    }
    return out;
}

struct Sums {
    double g = 0, s = 0, gg = 0, ss = 0, gs = 0, n = 0;

    void add(double gradient, double slope) {
        g += gradient, s += slope, gg += gradient * gradient, ss += slope * slope, gs += gradient * slope, n += 1;
    }
    double covariance() const { return gs / n - g / n * (s / n); }
    double variance_g() const { return std::max(0.0, gg / n - g / n * (g / n)); }
    double variance_s() const { return std::max(0.0, ss / n - s / n * (s / n)); }
    double correlation() const {
        // A slope of 1e-4 is below one step of an 8-bit normal map: no slope at all, and its sign is rounding.
        const double product = variance_g() * variance_s();
        return product > 0 && variance_s() > 1e-8 ? covariance() / std::sqrt(product) : 0.0;
    }
};

MapAgreement compare_at(const ImageF& height, const ImageF& normal) {
    const int w = height.width;
    const int h = height.height;
    Sums x, y;
    for (int j = 0; j < h; ++j) {
        const float* below = height.at(0, wrap_index(j - 1, h));
        const float* here = height.at(0, j);
        const float* above = height.at(0, wrap_index(j + 1, h));
        for (int i = 0; i < w; ++i) {
            const float* n = normal.at(i, j);
            // Steeper than 80 degrees the slope is mostly the noise of n.z, and a few such texels would outweigh all others.
            const double nz = std::max(static_cast<double>(n[2]), 0.17);
            x.add(0.5 * w * (here[wrap_index(i - 1, w)] - here[wrap_index(i + 1, w)]), n[0] / nz);
            y.add(0.5 * h * (below[i] - above[i]), n[1] / nz);
        }
    }
    MapAgreement agreement{.x = x.correlation(), .y = y.correlation(), .width = w, .height = h};
    // Least squares over both axes, each with the sign its convention has.
    const double variance = x.variance_g() + y.variance_g();
    if (variance > 0) agreement.height_scale = (std::abs(x.covariance()) + std::abs(y.covariance())) / variance;
    return agreement;
}

}  // namespace

// The scale is not known beforehand: a normal map may be blurred (agreement is finest when both are), sharpened, or hold only the
// fine detail; so every halving of the common size is tried and the clearest kept.
MapAgreement compare_maps(const HeightField& height, const ImageF& normal) {
    assert(normal.channels == 3);
    int width = std::min({height.width(), normal.width, largest_compared});
    int rows = std::min({height.height(), normal.height, largest_compared});
    MapAgreement best;
    ImageF heights, normals;
    for (; std::min(width, rows) >= smallest_compared; width /= 2, rows /= 2) {
        heights = shrink(heights.empty() ? height.texels : heights, width, rows);
        normals = shrink(normals.empty() ? normal : normals, width, rows);
        const MapAgreement here = compare_at(heights, normals);
        if (best.width == 0 || std::abs(here.x) + std::abs(here.y) > std::abs(best.x) + std::abs(best.y)) best = here;
    }
    return best;
}

MapReading read_agreement(const MapAgreement& agreement) {
    MapReading reading;
    const double axes = (agreement.x != 0) + (agreement.y != 0);
    if (axes == 0 || std::sqrt((agreement.x * agreement.x + agreement.y * agreement.y) / axes) < decisive_agreement) return reading;
    reading.polarity_decided = std::abs(agreement.x) >= decisive_correlation;
    reading.inverted = reading.polarity_decided && agreement.x < 0;
    reading.green_decided = std::abs(agreement.y) >= decisive_correlation;
    reading.green_down = reading.green_decided && (agreement.y < 0) != reading.inverted;
    return reading;
}

}  // namespace relievo
