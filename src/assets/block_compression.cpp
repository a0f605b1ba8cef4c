#include "assets/block_compression.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relievo {

namespace {

using Vector = std::array<double, 3>;
using Bytes3 = std::array<std::uint8_t, 3>;

double dot3(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

constexpr int levels_565[] = {31, 63, 31};

std::uint16_t packed(const std::array<int, 3>& c) { return static_cast<std::uint16_t>(c[0] << 11 | c[1] << 5 | c[2]); }

// The high bits again below the low ones, so that the largest value becomes 255.
Bytes3 unpacked(std::uint16_t c) {
    const int r = c >> 11, g = c >> 5 & 63, b = c & 31;
    return {static_cast<std::uint8_t>(r << 3 | r >> 2), static_cast<std::uint8_t>(g << 2 | g >> 4), static_cast<std::uint8_t>(b << 3 | b >> 2)};
}

std::uint16_t nearest_565(const Vector& c) {
    std::array<int, 3> q{};
    for (std::size_t k = 0; k < 3; ++k) q[k] = std::clamp(static_cast<int>(std::lround(c[k] * levels_565[k] / 255)), 0, levels_565[k]);
    return packed(q);
}

std::array<Bytes3, 4> palette(std::uint16_t a, std::uint16_t b) {
    const Bytes3 p = unpacked(a), q = unpacked(b);
    std::array<Bytes3, 4> all{p, q, {}, {}};
    for (std::size_t k = 0; k < 3; ++k) {
        all[2][k] = static_cast<std::uint8_t>((2 * p[k] + q[k] + 1) / 3);
        all[3][k] = static_cast<std::uint8_t>((p[k] + 2 * q[k] + 1) / 3);
    }
    return all;
}

struct Fit {
    std::uint16_t a = 0, b = 0;
    std::array<std::uint8_t, 16> index{};
    int error = 0;
};

Fit fitted(const ColourBlock& colours, std::uint16_t a, std::uint16_t b) {
    Fit fit{.a = a, .b = b, .index = {}, .error = 0};
    const auto all = palette(a, b);
    for (std::size_t t = 0; t < 16; ++t) {
        int least = 1 << 30;
        for (std::uint8_t i = 0; i < 4; ++i) {
            int e = 0;
            for (std::size_t k = 0; k < 3; ++k) e += (all[i][k] - colours[t][k]) * (all[i][k] - colours[t][k]);
            if (e < least) {
                least = e;
                fit.index[t] = i;
            }
        }
        fit.error += least;
    }
    return fit;
}

// For each value of a channel the ends whose mixture, two parts to one, is nearest to it; the nearer ends among equals, as decoders round
// differently.
std::array<int, 2> ends_of(int value, int levels) {
    std::array<int, 2> best{};
    int least = 1 << 30;
    const auto wide = [&](int q) { return levels == 63 ? q << 2 | q >> 4 : q << 3 | q >> 2; };
    for (int a = 0; a <= levels; ++a)
        for (int b = std::max(0, a - 3); b <= std::min(levels, a + 3); ++b) {
            const int e = std::abs((2 * wide(a) + wide(b) + 1) / 3 - value) * 16 + std::abs(a - b);
            if (e < least) {
                least = e;
                best = {a, b};
            }
        }
    return best;
}

std::array<std::uint8_t, 8> bytes_of(Fit fit) {
    // The mode of four colours has the larger end first. Ends that are equal say one colour in either mode.
    if (fit.a < fit.b) {
        std::swap(fit.a, fit.b);
        for (std::uint8_t& i : fit.index) i = static_cast<std::uint8_t>(i ^ 1u);
    }
    if (fit.a == fit.b) fit.index = {};
    std::array<std::uint8_t, 8> block{static_cast<std::uint8_t>(fit.a & 255), static_cast<std::uint8_t>(fit.a >> 8), static_cast<std::uint8_t>(fit.b & 255), static_cast<std::uint8_t>(fit.b >> 8)};
    for (std::size_t t = 0; t < 16; ++t) block[4 + t / 4] = static_cast<std::uint8_t>(block[4 + t / 4] | fit.index[t] << (2 * (t % 4)));
    return block;
}

std::array<std::uint8_t, 8> grey_palette(int a, int b) {
    std::array<std::uint8_t, 8> p{static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(b)};
    if (a > b) {
        for (int i = 1; i < 7; ++i) p[static_cast<std::size_t>(i) + 1] = static_cast<std::uint8_t>(((7 - i) * a + i * b + 3) / 7);
    } else {
        for (int i = 1; i < 5; ++i) p[static_cast<std::size_t>(i) + 1] = static_cast<std::uint8_t>(((5 - i) * a + i * b + 2) / 5);
        p[6] = 0;
        p[7] = 255;
    }
    return p;
}

struct GreyFit {
    int a = 0, b = 0, error = 0;
    std::array<std::uint8_t, 16> index{};
};

GreyFit grey_fitted(const GreyBlock& values, int a, int b) {
    GreyFit fit{.a = a, .b = b, .error = 0, .index = {}};
    const auto p = grey_palette(a, b);
    for (std::size_t t = 0; t < 16; ++t) {
        int least = 1 << 30;
        for (std::uint8_t i = 0; i < 8; ++i) {
            const int e = (p[i] - values[t]) * (p[i] - values[t]);
            if (e < least) {
                least = e;
                fit.index[t] = i;
            }
        }
        fit.error += least;
    }
    return fit;
}

}  // namespace

std::array<std::uint8_t, 8> bc1_block(const ColourBlock& colours) {
    if (std::ranges::all_of(colours, [&](const Bytes3& c) { return c == colours[0]; })) {
        std::array<int, 3> a{}, b{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::array<int, 2> ends = ends_of(colours[0][k], levels_565[k]);
            a[k] = ends[0];
            b[k] = ends[1];
        }
        return bytes_of(fitted(colours, packed(a), packed(b)));
    }
    Vector mean{};
    for (const Bytes3& c : colours)
        for (std::size_t k = 0; k < 3; ++k) mean[k] += c[k] / 16.0;
    std::array<Vector, 3> spread{};
    for (const Bytes3& c : colours)
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k) spread[i][k] += (c[i] - mean[i]) * (c[k] - mean[k]);
    // The main axis, from the channel that spreads most: a few multiplications turn it.
    const std::size_t most = spread[0][0] >= spread[1][1] && spread[0][0] >= spread[2][2] ? 0 : spread[1][1] >= spread[2][2] ? 1 : 2;
    Vector axis = spread[most];
    for (int step = 0; step < 8; ++step) {
        const Vector next{dot3(spread[0], axis), dot3(spread[1], axis), dot3(spread[2], axis)};
        const double l = std::sqrt(dot3(next, next));
        if (!(l > 0)) break;
        axis = {next[0] / l, next[1] / l, next[2] / l};
    }
    double low = 1e30, high = -1e30;
    for (const Bytes3& c : colours) {
        const double along = dot3({c[0] - mean[0], c[1] - mean[1], c[2] - mean[2]}, axis);
        low = std::min(low, along);
        high = std::max(high, along);
    }
    const auto at = [&](double along) { return Vector{mean[0] + axis[0] * along, mean[1] + axis[1] * along, mean[2] + axis[2] * along}; };
    Fit best = fitted(colours, nearest_565(at(high)), nearest_565(at(low)));
    Fit last = best;
    for (int step = 0; step < 4; ++step) {
        // The ends that, mixed as the indices say, come nearest to the colours.
        constexpr double share[] = {1, 0, 2.0 / 3, 1.0 / 3};
        double aa = 0, ab = 0, bb = 0;
        Vector ca{}, cb{};
        for (std::size_t t = 0; t < 16; ++t) {
            const double u = share[last.index[t]], v = 1 - u;
            aa += u * u;
            ab += u * v;
            bb += v * v;
            for (std::size_t k = 0; k < 3; ++k) {
                ca[k] += u * colours[t][k];
                cb[k] += v * colours[t][k];
            }
        }
        const double det = aa * bb - ab * ab;
        if (!(det > 1e-9)) break;
        Vector a{}, b{};
        for (std::size_t k = 0; k < 3; ++k) {
            a[k] = (ca[k] * bb - cb[k] * ab) / det;
            b[k] = (cb[k] * aa - ca[k] * ab) / det;
        }
        last = fitted(colours, nearest_565(a), nearest_565(b));
        if (last.error >= best.error) break;
        best = last;
    }
    return bytes_of(best);
}

std::array<std::uint8_t, 8> bc4_block(const GreyBlock& values) {
    const auto [low, high] = std::ranges::minmax(values);
    int inner_low = 255, inner_high = 0;
    for (const std::uint8_t v : values)
        if (v != 0 && v != 255) {
            inner_low = std::min<int>(inner_low, v);
            inner_high = std::max<int>(inner_high, v);
        }
    if (inner_low > inner_high) inner_low = inner_high = 0;
    GreyFit best = grey_fitted(values, inner_low, inner_high);
    if (high > low) {
        const GreyFit eight = grey_fitted(values, high, low);
        if (eight.error < best.error) best = eight;
    }
    std::array<std::uint8_t, 8> block{static_cast<std::uint8_t>(best.a), static_cast<std::uint8_t>(best.b)};
    std::uint64_t bits = 0;
    for (std::size_t t = 0; t < 16; ++t) bits |= std::uint64_t{best.index[t]} << (3 * t);
    for (std::size_t i = 0; i < 6; ++i) block[2 + i] = static_cast<std::uint8_t>(bits >> (8 * i));
    return block;
}

ColourBlock decoded_bc1(const std::array<std::uint8_t, 8>& block) {
    const auto a = static_cast<std::uint16_t>(block[0] | block[1] << 8), b = static_cast<std::uint16_t>(block[2] | block[3] << 8);
    const auto all = palette(a, b);
    ColourBlock colours;
    for (std::size_t t = 0; t < 16; ++t) colours[t] = all[block[4 + t / 4] >> (2 * (t % 4)) & 3];
    return colours;
}

GreyBlock decoded_bc4(const std::array<std::uint8_t, 8>& block) {
    const auto p = grey_palette(block[0], block[1]);
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < 6; ++i) bits |= std::uint64_t{block[2 + i]} << (8 * i);
    GreyBlock values;
    for (std::size_t t = 0; t < 16; ++t) values[t] = p[bits >> (3 * t) & 7];
    return values;
}

}  // namespace relievo
