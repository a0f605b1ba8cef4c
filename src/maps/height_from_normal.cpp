#include "maps/height_from_normal.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace relievo {

namespace {

using Complex = std::complex<double>;

// exp(-2 pi i k / n), the angle reduced in integers.
Complex root_of_unity(long long k, long long n) {
    const double angle = -2 * std::numbers::pi * static_cast<double>(k % n) / static_cast<double>(n);
    return {std::cos(angle), std::sin(angle)};
}

// Forward discrete Fourier transforms of one length: radix 2 (Cooley & Tukey 1965) for powers of two, any other length as a
// convolution of a padded power of two (Bluestein 1970). std::complex's product checks for NaN, hence the explicit ones.
class Fourier {
public:
    explicit Fourier(int size) : size_(size) {
        const bool power_of_two = std::has_single_bit(static_cast<unsigned>(size));
        const auto padded = static_cast<int>(std::bit_ceil(static_cast<unsigned>(power_of_two ? size : 2 * size - 1)));
        twiddles_.resize(static_cast<std::size_t>(std::max(1, padded / 2)));
        for (int k = 0; k < padded / 2; ++k) twiddles_[static_cast<std::size_t>(k)] = root_of_unity(k, padded);
        if (power_of_two) return;
        chirp_.resize(static_cast<std::size_t>(size));
        for (int k = 0; k < size; ++k) chirp_[static_cast<std::size_t>(k)] = root_of_unity(static_cast<long long>(k) * k, 2LL * size);
        kernel_.assign(static_cast<std::size_t>(padded), 0.0);
        for (int k = 0; k < size; ++k) {
            kernel_[static_cast<std::size_t>(k)] = std::conj(chirp_[static_cast<std::size_t>(k)]);
            if (k > 0) kernel_[static_cast<std::size_t>(padded - k)] = kernel_[static_cast<std::size_t>(k)];
        }
        radix2(kernel_);
    }

    void transform(std::vector<Complex>& values, std::vector<Complex>& scratch) const {
        if (chirp_.empty()) {
            radix2(values);
            return;
        }
        scratch.assign(kernel_.size(), 0.0);
        for (std::size_t k = 0; k < chirp_.size(); ++k) scratch[k] = product(values[k], chirp_[k]);
        radix2(scratch);
        // The inverse transform is the forward one of the conjugate.
        for (std::size_t k = 0; k < scratch.size(); ++k) scratch[k] = std::conj(product(scratch[k], kernel_[k]));
        radix2(scratch);
        const double share = 1.0 / static_cast<double>(scratch.size());
        for (std::size_t k = 0; k < chirp_.size(); ++k) values[k] = product(std::conj(scratch[k]) * share, chirp_[k]);
    }

    int size() const { return size_; }

private:
    static Complex product(Complex a, Complex b) {
        return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
    }

    void radix2(std::vector<Complex>& values) const {
        const std::size_t n = values.size();
        for (std::size_t i = 1, j = 0; i < n; ++i) {
            std::size_t bit = n >> 1;
            for (; j & bit; bit >>= 1) j ^= bit;
            j ^= bit;
            if (i < j) std::swap(values[i], values[j]);
        }
        for (std::size_t half = 1; half < n; half *= 2)
            for (std::size_t block = 0; block < n; block += 2 * half)
                for (std::size_t k = 0; k < half; ++k) {
                    const Complex odd = product(values[block + half + k], twiddles_[k * (n / 2 / half)]);
                    const Complex even = values[block + k];
                    values[block + k] = even + odd;
                    values[block + half + k] = even - odd;
                }
    }

    int size_;
    std::vector<Complex> twiddles_;
    std::vector<Complex> chirp_, kernel_;  // of Bluestein's form; empty for powers of two
};

struct Spectrum {
    int width, height;
    std::vector<Complex> values;
    Complex& operator()(int i, int j) { return values[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)]; }
};

void transform(Spectrum& s, int threads, const Progress& progress, std::string_view stage) {
    const Fourier across(s.width);
    const Fourier up(s.height);
    parallel_for(s.height, 8, threads, [&](int begin, int end) {
        std::vector<Complex> line(static_cast<std::size_t>(s.width)), scratch;
        for (int j = begin; j < end; ++j) {
            std::copy_n(&s(0, j), s.width, line.begin());
            across.transform(line, scratch);
            std::ranges::copy(line, &s(0, j));
        }
    }, progress, stage);
    // Eight columns at a time, so that a cache line of the image is read once.
    parallel_for(s.width, 8, threads, [&](int begin, int end) {
        std::vector<std::vector<Complex>> lines(static_cast<std::size_t>(end - begin), std::vector<Complex>(static_cast<std::size_t>(s.height)));
        std::vector<Complex> scratch;
        for (int j = 0; j < s.height; ++j)
            for (int i = begin; i < end; ++i) lines[static_cast<std::size_t>(i - begin)][static_cast<std::size_t>(j)] = s(i, j);
        for (auto& line : lines) up.transform(line, scratch);
        for (int j = 0; j < s.height; ++j)
            for (int i = begin; i < end; ++i) s(i, j) = lines[static_cast<std::size_t>(i - begin)][static_cast<std::size_t>(j)];
    }, progress, stage);
}

// Angular frequency of bin k; 0 for the Nyquist bin of an even size, whose slope at the texel centres cannot be told.
double frequency(int k, int size) {
    if (2 * k == size) return 0;
    return 2 * std::numbers::pi * (2 * k < size ? k : k - size);
}

}  // namespace

IntegratedHeight height_from_normal(const ImageF& normals, int threads, const Progress& progress) {
    assert(normals.channels == 3 && !normals.empty());
    const int width = normals.width;
    const int height = normals.height;
    const double steepest = std::tan(87 * std::numbers::pi / 180);

    // Both slopes are real: one complex transform, dz/du + i dz/dv, carries the two.
    Spectrum s{width, height, std::vector<Complex>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
    parallel_for(height, 32, threads, [&](int begin, int end) {
        for (int j = begin; j < end; ++j)
            for (int i = 0; i < width; ++i) {
                const float* n = normals.at(i, j);
                const double lean = std::hypot(n[0], n[1]);
                if (lean == 0) continue;
                const double slope = n[2] > 0 ? std::min(lean / n[2], steepest) : steepest;
                s(i, j) = {-n[0] / lean * slope, -n[1] / lean * slope};
            }
    });
    double power = 0;
    for (const Complex& c : s.values) power += std::norm(c);
    transform(s, threads, progress, "heights from normals: analysis");

    const double texels = static_cast<double>(width) * height;
    IntegratedHeight result;
    result.mean_slope = {static_cast<float>(s(0, 0).real() / texels), static_cast<float>(s(0, 0).imag() / texels)};
    power -= std::norm(s(0, 0)) / texels;

    // z = -i (wx P + wy Q) / (wx^2 + wy^2), P and Q recovered from the Hermitian halves of P + iQ. Both bins of a conjugate pair are
    // replaced together. The inverse transform is the forward one of the conjugate; z is real, so the conjugate is all it takes.
    double unexplained = 0;
    Spectrum z{width, height, std::vector<Complex>(s.values.size())};
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
            if (i == 0 && j == 0) continue;
            const Complex here = s(i, j);
            const Complex mirrored = std::conj(s((width - i) % width, (height - j) % height));
            const Complex p = (here + mirrored) * 0.5;
            const Complex q = Complex{0, -0.5} * (here - mirrored);
            const double wx = frequency(i, width);
            const double wy = frequency(j, height);
            const double w2 = wx * wx + wy * wy;
            const Complex value = w2 > 0 ? Complex{0, -1} * (wx * p + wy * q) / w2 : Complex{};
            z(i, j) = std::conj(value);
            const Complex left_p = p - Complex{0, wx} * value;
            const Complex left_q = q - Complex{0, wy} * value;
            unexplained += std::norm(left_p) + std::norm(left_q);
        }
    s.values = {};
    if (power > 1e-12 * texels) result.inconsistency = static_cast<float>(std::sqrt(unexplained / texels / power));
    transform(z, threads, progress, "heights from normals: synthesis");

    double low = z(0, 0).real();
    double high = low;
    for (const Complex& c : z.values) {
        low = std::min(low, c.real());
        high = std::max(high, c.real());
    }
    const double range = (high - low) / texels;
    result.height = HeightField(width, height, 1.0f);
    // Rounding of 8-bit and even of float normals stays far above this; below it there is no relief.
    if (range < 1e-9) return result;
    result.height_scale = static_cast<float>(range);
    for (std::size_t k = 0; k < z.values.size(); ++k)
        result.height.texels.texels[k] = static_cast<float>((z.values[k].real() - low) / (high - low));
    return result;
}

}  // namespace relievo
