#include "maps/mip_chain.h"

#include "core/parallel_for.h"
#include "core/vec.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace relievo {

namespace {

// The source texels under one texel of the next level along one axis, and the share of each. Halving an odd size n = 2m + 1
// stretches a texel over 2 + 1/m source texels, so up to three take part.
struct Taps {
    int first = 0;
    int count = 0;
    std::array<float, 3> weight{};
};

std::vector<Taps> halving_taps(int size) {
    const int half = std::max(1, size / 2);
    std::vector<Taps> taps(static_cast<std::size_t>(half));
    for (int i = 0; i < half; ++i) {
        // In units of 1/half source texels everything is an integer: the texel covers [i * size, (i + 1) * size).
        const std::int64_t begin = std::int64_t{i} * size;
        const std::int64_t end = begin + size;
        Taps& t = taps[static_cast<std::size_t>(i)];
        t.first = static_cast<int>(begin / half);
        for (std::int64_t s = t.first; s * half < end; ++s) {
            assert(t.count < 3);
            const std::int64_t covered = std::min(end, (s + 1) * half) - std::max(begin, s * half);
            t.weight[static_cast<std::size_t>(t.count++)] = static_cast<float>(covered) / static_cast<float>(size);
        }
    }
    return taps;
}

// The next level in float; `value(source, c)` reads channel c of a source texel.
template <class T, class Value>
ImageF halve(const Image<T>& source, int threads, const Value& value) {
    const int channels = source.channels;
    const std::vector<Taps> across = halving_taps(source.width);
    const std::vector<Taps> up = halving_taps(source.height);
    ImageF out(static_cast<int>(across.size()), static_cast<int>(up.size()), channels);
    parallel_for(out.height, 16, threads, [&](int begin, int end) {
        for (int j = begin; j < end; ++j) {
            const Taps& v = up[static_cast<std::size_t>(j)];
            for (int i = 0; i < out.width; ++i) {
                const Taps& u = across[static_cast<std::size_t>(i)];
                std::array<float, 4> sum{};
                for (int b = 0; b < v.count; ++b) {
                    const T* texel = source.at(u.first, v.first + b);
                    for (int a = 0; a < u.count; ++a, texel += channels) {
                        const float weight = u.weight[static_cast<std::size_t>(a)] * v.weight[static_cast<std::size_t>(b)];
                        for (int c = 0; c < channels; ++c) sum[static_cast<std::size_t>(c)] += weight * value(texel[c], c);
                    }
                }
                std::copy_n(sum.begin(), channels, out.at(i, j));
            }
        }
    });
    return out;
}

bool is_last(int width, int height) { return width == 1 && height == 1; }

ImageF renormalised(const ImageF& means) {
    ImageF out(means.width, means.height, 3);
    for (std::size_t k = 0; k < means.texels.size(); k += 3) {
        const Vec3f mean{means.texels[k], means.texels[k + 1], means.texels[k + 2]};
        const float size = length(mean);
        const Vec3f n = size > 0 ? mean / size : Vec3f{0, 0, 1};
        out.texels[k] = n.x;
        out.texels[k + 1] = n.y;
        out.texels[k + 2] = n.z;
    }
    return out;
}

// Decoding is a table; encoding searches the same table's midpoints, so that decode then encode is exact for all 256 codes.
struct SrgbCodes {
    std::array<float, 256> linear{};
    std::array<float, 255> threshold{};  // encoded midpoints between neighbouring codes, in linear light

    SrgbCodes() {
        for (int i = 0; i < 256; ++i) linear[static_cast<std::size_t>(i)] = srgb_to_linear(static_cast<float>(i) / 255.0f);
        for (int i = 0; i < 255; ++i)
            threshold[static_cast<std::size_t>(i)] = srgb_to_linear((static_cast<float>(i) + 0.5f) / 255.0f);
    }
    std::uint8_t nearest(float value) const {
        return static_cast<std::uint8_t>(std::upper_bound(threshold.begin(), threshold.end(), value) - threshold.begin());
    }
};

const SrgbCodes& srgb_codes() {
    static const SrgbCodes codes;
    return codes;
}

Image8 encoded(const ImageF& linear, int threads) {
    const SrgbCodes& codes = srgb_codes();
    Image8 out(linear.width, linear.height, 4);
    parallel_for(out.height, 32, threads, [&](int begin, int end) {
        for (int j = begin; j < end; ++j)
            for (int i = 0; i < out.width; ++i) {
                const float* from = linear.at(i, j);
                std::uint8_t* to = out.at(i, j);
                for (int c = 0; c < 3; ++c) to[c] = codes.nearest(from[c]);
                to[3] = static_cast<std::uint8_t>(std::clamp(from[3] * 255.0f + 0.5f, 0.0f, 255.0f));
            }
    });
    return out;
}

}  // namespace

float srgb_to_linear(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float linear_to_srgb(float linear) {
    return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

std::vector<ImageF> normal_mip_chain(ImageF normals, int threads) {
    assert(normals.channels == 3 && !normals.empty());
    std::vector<ImageF> chain;
    chain.push_back(std::move(normals));
    const auto identity = [](float x, int) { return x; };
    ImageF means;  // of level 0, not renormalised
    while (!is_last(chain.back().width, chain.back().height)) {
        means = halve(means.empty() ? chain.front() : means, threads, identity);
        chain.push_back(renormalised(means));
    }
    return chain;
}

std::vector<Image8> colour_mip_chain(Image8 colour, int threads) {
    assert(colour.channels == 4 && !colour.empty());
    std::vector<Image8> chain;
    chain.push_back(std::move(colour));
    const SrgbCodes& codes = srgb_codes();
    ImageF means;  // linear light
    while (!is_last(chain.back().width, chain.back().height)) {
        if (means.empty())
            means = halve(chain.front(), threads, [&](std::uint8_t x, int c) {
                return c < 3 ? codes.linear[x] : static_cast<float>(x) / 255.0f;
            });
        else
            means = halve(means, threads, [](float x, int) { return x; });
        chain.push_back(encoded(means, threads));
    }
    return chain;
}

}  // namespace relievo
