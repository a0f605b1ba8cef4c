#include "measure/display_values.h"

#include "core/error.h"
#include "core/parallel_for.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace relievo {

namespace {

// Rows are checked on several threads, but the message must not depend on which of them is first: the whole picture is
// searched again, in order, once a bad value is known to exist.
[[noreturn]] void throw_first_bad_pixel(const ImageF& image, const std::string& name) {
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < image.channels; ++c) {
                const float v = image(x, y, c);
                if (std::isfinite(v)) continue;
                throw Error("compare", name, "pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") has " +
                            (std::isnan(v) ? "NaN" : "an infinite value") + " in channel " + std::to_string(c),
                            "pixels count from the top left corner; a picture must hold finite numbers");
            }
        }
    }
    throw Error("compare", name, "it holds a value that is not finite");
}

template <class F>
ImageF mapped(const ImageF& image, const std::string& name, int threads, F&& f) {
    assert(image.channels == 3);
    ImageF out(image.width, image.height, image.channels);
    const std::size_t row = static_cast<std::size_t>(image.width) * 3;
    std::vector<std::uint8_t> bad(static_cast<std::size_t>(image.height), 0);
    parallel_for(image.height, 16, threads, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            const float* in = image.texels.data() + row * static_cast<std::size_t>(y);
            float* to = out.texels.data() + row * static_cast<std::size_t>(y);
            bool finite = true;
            for (std::size_t i = 0; i < row; ++i) {
                // Written so that NaN and infinity fail the test.
                finite &= std::abs(in[i]) <= 3.402823466e38f;
                to[i] = f(std::min(1.0f, std::max(0.0f, in[i])));
            }
            bad[static_cast<std::size_t>(y)] = finite ? 0 : 1;
        }
    });
    if (std::find(bad.begin(), bad.end(), 1) != bad.end()) throw_first_bad_pixel(image, name);
    return out;
}

}  // namespace

float srgb_encoded(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
}

ImageF clamped_to_display(const ImageF& linear_rgb, const std::string& name, int threads) {
    return mapped(linear_rgb, name, threads, [](float v) { return v; });
}

ImageF display_values(const ImageF& linear_rgb, const std::string& name, int threads) {
    return mapped(linear_rgb, name, threads, srgb_encoded);
}

}  // namespace relievo
