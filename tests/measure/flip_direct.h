// LDR-FLIP once more, as slowly and plainly as the paper (Andersson et al. 2020) writes it: two-dimensional kernels, double,
// every channel in its own units. It shares no code with src/measure, so that the two can only agree by being right.
#pragma once

#include "core/image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace relievo::test {

class DirectFlip {
public:
    explicit DirectFlip(double pixels_per_degree) : ppd_(pixels_per_degree) {
        // Primaries and white of sRGB by their chromaticities, solved for equal RGB = white.
        const double x[3] = {0.64, 0.30, 0.15}, y[3] = {0.33, 0.60, 0.06}, xw = 0.3127, yw = 0.3290;
        white_ = {xw / yw, 1, (1 - xw - yw) / yw};
        double p[3][3];
        for (int c = 0; c < 3; ++c) {
            p[0][c] = x[c] / y[c];
            p[1][c] = 1;
            p[2][c] = (1 - x[c] - y[c]) / y[c];
        }
        std::array<double, 3> s = solve(p, white_);
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) m_[r][c] = p[r][c] * s[c];
        }
    }

    // Linear RGB in [0,1], 3 channels; the error per pixel.
    std::vector<double> operator()(const ImageF& a, const ImageF& b) const {
        const auto la = filtered_lab(a), lb = filtered_lab(b);
        const auto ea = features(a, true), eb = features(b, true), pa = features(a, false), pb = features(b, false);
        const double c_max = std::pow(hyab(lab({0, 1, 0}), lab({0, 0, 1})), 0.7);
        std::vector<double> error;
        for (std::size_t i = 0; i < la.size(); ++i) {
            double colour = std::pow(hyab(la[i], lb[i]), 0.7);
            colour = colour < 0.4 * c_max ? 0.95 / (0.4 * c_max) * colour : 0.95 + (colour - 0.4 * c_max) / (c_max - 0.4 * c_max) * 0.05;
            const double feature = std::pow(std::max(std::abs(ea[i] - eb[i]), std::abs(pa[i] - pb[i])) / std::sqrt(2.0), 0.5);
            error.push_back(std::pow(colour, 1 - feature));
        }
        return error;
    }

private:
    using V = std::array<double, 3>;
    using Plane = std::vector<double>;

    // Cramer's rule.
    static V solve(const double (&m)[3][3], const V& b) {
        const auto det = [](const double (&q)[3][3]) {
            return q[0][0] * (q[1][1] * q[2][2] - q[1][2] * q[2][1]) - q[0][1] * (q[1][0] * q[2][2] - q[1][2] * q[2][0]) +
                   q[0][2] * (q[1][0] * q[2][1] - q[1][1] * q[2][0]);
        };
        V out{};
        for (int c = 0; c < 3; ++c) {
            double q[3][3];
            for (int r = 0; r < 3; ++r) {
                for (int k = 0; k < 3; ++k) q[r][k] = k == c ? b[r] : m[r][k];
            }
            out[c] = det(q) / det(m);
        }
        return out;
    }

    V xyz(const V& rgb) const {
        V o{};
        for (int r = 0; r < 3; ++r) o[r] = m_[r][0] * rgb[0] + m_[r][1] * rgb[1] + m_[r][2] * rgb[2];
        return o;
    }
    V ycxcz(const V& rgb) const {
        const V v = xyz(rgb);
        const double x = v[0] / white_[0], y = v[1] / white_[1], z = v[2] / white_[2];
        return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
    }
    V rgb_of_ycxcz(const V& o) const {
        const double y = (o[0] + 16) / 116, x = o[1] / 500 + y, z = y - o[2] / 200;
        return solve(m_, {x * white_[0], y * white_[1], z * white_[2]});
    }
    V lab(const V& rgb) const {
        const V v = xyz(rgb);
        const auto f = [](double t) { return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116; };
        const double fx = f(v[0] / white_[0]), fy = f(v[1] / white_[1]), fz = f(v[2] / white_[2]);
        const double l = 116 * fy - 16;
        return {l, 0.01 * l * 500 * (fx - fy), 0.01 * l * 200 * (fy - fz)};
    }
    static double hyab(const V& a, const V& b) { return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]); }

    static V pixel(const ImageF& image, int x, int y) {
        const float* p = image.at(std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1));
        return {p[0], p[1], p[2]};
    }

    // kernel(x, y) over the square of `radius`, applied to f(pixel).
    static Plane convolved(const ImageF& image, int radius, const std::function<double(int, int)>& kernel,
                           const std::function<double(const V&)>& f) {
        Plane values, out;
        for (int y = -radius; y < image.height + radius; ++y) {
            for (int x = -radius; x < image.width + radius; ++x) values.push_back(f(pixel(image, x, y)));
        }
        const int stride = image.width + 2 * radius;
        Plane weights;
        for (int j = -radius; j <= radius; ++j) {
            for (int i = -radius; i <= radius; ++i) weights.push_back(kernel(i, j));
        }
        for (int y = 0; y < image.height; ++y) {
            for (int x = 0; x < image.width; ++x) {
                double sum = 0;
                std::size_t k = 0;
                for (int j = -radius; j <= radius; ++j) {
                    for (int i = -radius; i <= radius; ++i) {
                        sum += weights[k++] * values[static_cast<std::size_t>((y + j + radius) * stride + x + i + radius)];
                    }
                }
                out.push_back(sum);
            }
        }
        return out;
    }

    std::vector<V> filtered_lab(const ImageF& image) const {
        const double a1[3] = {1, 1, 34.1}, b1[3] = {0.0047, 0.0053, 0.04}, a2[3] = {0, 0, 13.5}, b2[3] = {1e-5, 1e-5, 0.025};
        const double pi = std::numbers::pi;
        const int radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * ppd_));
        Plane channel[3];
        for (int c = 0; c < 3; ++c) {
            const auto g = [&](int i, int j) {
                const double d2 = (i * i + j * j) / (ppd_ * ppd_);
                return a1[c] * std::sqrt(pi / b1[c]) * std::exp(-pi * pi * d2 / b1[c]) +
                       a2[c] * std::sqrt(pi / b2[c]) * std::exp(-pi * pi * d2 / b2[c]);
            };
            double sum = 0;
            for (int j = -radius; j <= radius; ++j) {
                for (int i = -radius; i <= radius; ++i) sum += g(i, j);
            }
            channel[c] = convolved(image, radius, [&](int i, int j) { return g(i, j) / sum; }, [&](const V& p) { return ycxcz(p)[c]; });
        }
        std::vector<V> out;
        for (std::size_t i = 0; i < channel[0].size(); ++i) {
            V rgb = rgb_of_ycxcz({channel[0][i], channel[1][i], channel[2][i]});
            for (double& v : rgb) v = std::clamp(v, 0.0, 1.0);
            out.push_back(lab(rgb));
        }
        return out;
    }

    Plane features(const ImageF& image, bool edges) const {
        const double sigma = 0.5 * 0.082 * ppd_;
        const int radius = static_cast<int>(std::ceil(3 * sigma));
        const auto raw = [&](int i, int j) {
            const double gaussian = std::exp(-(i * i + j * j) / (2 * sigma * sigma));
            return edges ? -i * gaussian : (i * i / (sigma * sigma) - 1) * gaussian;
        };
        double positive = 0, negative = 0;
        for (int j = -radius; j <= radius; ++j) {
            for (int i = -radius; i <= radius; ++i) (raw(i, j) > 0 ? positive : negative) += std::abs(raw(i, j));
        }
        const auto along_x = [&](int i, int j) { return raw(i, j) / (raw(i, j) > 0 ? positive : negative); };
        const auto luminance = [&](const V& p) { return (ycxcz(p)[0] + 16) / 116; };
        const Plane x = convolved(image, radius, along_x, luminance);
        const Plane y = convolved(image, radius, [&](int i, int j) { return along_x(j, i); }, luminance);
        Plane out;
        for (std::size_t i = 0; i < x.size(); ++i) out.push_back(std::hypot(x[i], y[i]));
        return out;
    }

    double ppd_;
    double m_[3][3];
    V white_;
};

}  // namespace relievo::test
