#include "pipeline/fur_score.h"

#include "assets/image_file.h"
#include "core/parallel_for.h"
#include "measure/flip.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <vector>

namespace relievo {

namespace {

// A studio's paper: lighter behind the middle, darker toward the edges and below. The glow is a product of one across and one down.
class Backdrop {
public:
    Backdrop(int width, int height) : across_(glow(width, 0.5)), down_(glow(height, 0.42)) {}
    Vec3f at(int x, int y) const {
        const double v = 0.13 + 0.27 * across_[static_cast<std::size_t>(x)] * down_[static_cast<std::size_t>(y)];
        return Vec3f(Vec3d(v, v * 1.01, v * 1.03));
    }

private:
    static std::vector<double> glow(int size, double middle) {
        std::vector<double> g(static_cast<std::size_t>(size));
        for (int i = 0; i < size; ++i) {
            const double d = (i + 0.5) / size - middle;
            g[static_cast<std::size_t>(i)] = std::exp(-3.0 * d * d);
        }
        return g;
    }
    std::vector<double> across_, down_;
};

// A row in linear light, before the backdrop, three channels.
void write_row(const FurFrames& frames, const Backdrop& backdrop, int y, float* to) {
    for (int x = 0; x < frames.colour.width; ++x, to += 3) {
        const float open = 1 - frames.coverage(x, y);
        const Vec3f behind = backdrop.at(x, y);
        const float* c = frames.colour.at(x, y);
        to[0] = c[0] + open * behind.x;
        to[1] = c[1] + open * behind.y;
        to[2] = c[2] + open * behind.z;
    }
}

ImageF before_backdrop(const FurFrames& frames) {
    ImageF all(frames.colour.width, frames.colour.height, 3);
    const Backdrop backdrop(all.width, all.height);
    for (int y = 0; y < all.height; ++y) write_row(frames, backdrop, y, all.at(0, y));
    return all;
}

// srgb_from_linear without its power for every texel: a table of the code at 4096 places leads to the code itself, by the least values
// that have each.
class SrgbTable {
public:
    SrgbTable() {
        for (std::size_t code = 1; code < 256; ++code) {
            // The least value that is given the code, found among floats, which are in the order of their bits.
            std::uint32_t low = 0, high = std::bit_cast<std::uint32_t>(1.0f);
            while (low < high) {
                const std::uint32_t middle = low + (high - low) / 2;
                if (srgb_from_linear(std::bit_cast<float>(middle)) >= code) high = middle;
                else low = middle + 1;
            }
            least_[code] = std::bit_cast<float>(low);
        }
        for (std::size_t i = 0; i < places; ++i) code_[i] = srgb_from_linear(static_cast<float>(i) / places);
    }
    std::uint8_t operator()(float v) const {
        if (!(v > 0)) return 0;
        if (v >= 1) return 255;
        std::uint8_t code = code_[static_cast<std::size_t>(v * places)];
        while (code < 255 && v >= least_[code + 1u]) ++code;
        return code;
    }

private:
    static constexpr std::size_t places = 4096;
    std::array<float, 256> least_{};
    std::array<std::uint8_t, places> code_{};
};

}  // namespace

Image8 shown_fur(const FurFrames& frames) {
    static const SrgbTable encoded;
    Image8 picture(frames.colour.width, frames.colour.height, 3);
    const Backdrop backdrop(picture.width, picture.height);
    parallel_for(picture.height, 16, 0, [&](int begin, int end) {
        std::vector<float> row(static_cast<std::size_t>(picture.width) * 3);
        for (int y = begin; y < end; ++y) {
            write_row(frames, backdrop, y, row.data());
            std::transform(row.begin(), row.end(), picture.at(0, y), [&](float v) { return encoded(v); });
        }
    });
    return picture;
}

Image8 side_by_side(const Image8& left, const Image8& right) {
    Image8 both(left.width + right.width, left.height, 3);
    for (int y = 0; y < left.height; ++y) {
        std::copy_n(left.at(0, y), left.width * 3, both.at(0, y));
        std::copy_n(right.at(0, y), right.width * 3, both.at(left.width, y));
    }
    return both;
}

FurScore fur_score(const FurFrames& picture, const FurFrames& reference, int threads) {
    FurScore score;
    score.flip = flip(before_backdrop(picture), before_backdrop(reference), {.threads = threads}).mean;
    double sum = 0;
    std::size_t either = 0, inside = 0, open = 0;
    for (std::size_t p = 0; p < reference.coverage.texels.size(); ++p) {
        const float a = picture.coverage.texels[p], b = reference.coverage.texels[p];
        if (a > 0 || b > 0) {
            ++either;
            sum += std::abs(static_cast<double>(a) - static_cast<double>(b));
        }
        inside += b > 0.5f;
        open += b > 0.5f && a < 0.25f;
    }
    if (either > 0) score.coverage_error = sum / static_cast<double>(either);
    if (inside > 0) score.gaps = static_cast<double>(open) / static_cast<double>(inside);
    return score;
}

}  // namespace relievo
