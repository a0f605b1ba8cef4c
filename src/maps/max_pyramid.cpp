#include "maps/max_pyramid.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <bit>

namespace relievo {

namespace {

int padded(int size, int levels) {
    const int unit = 1 << (levels - 1);
    return (size + unit - 1) / unit * unit;
}

}  // namespace

int max_pyramid_levels(int width, int height) {
    assert(width > 0 && height > 0);
    const int log2_longer = static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(width, height)))) - 1;
    int levels = std::max(1, log2_longer - 1);
    // Only the shorter side of a long thin field can be padded to more than twice its texels.
    while (levels > 1 && padded(std::min(width, height), levels) > 2 * std::min(width, height)) --levels;
    return levels;
}

MaxPyramid max_pyramid(const HeightField& field, int threads) {
    const int width = field.width();
    const int height = field.height();
    const int levels = max_pyramid_levels(width, height);
    MaxPyramid pyramid{.cells_x = width, .cells_y = height, .levels = {}};
    pyramid.levels.reserve(static_cast<std::size_t>(levels));

    ImageF& cells = pyramid.levels.emplace_back(padded(width, levels), padded(height, levels), 1, 0.0f);
    parallel_for(height, 32, threads, [&](int begin, int end) {
        for (int j = begin; j < end; ++j) {
            const float* low = field.texels.at(0, j);
            const float* high = field.texels.at(0, j + 1 < height ? j + 1 : 0);
            float* out = cells.at(0, j);
            for (int i = 0; i + 1 < width; ++i)
                out[i] = std::max(std::max(low[i], low[i + 1]), std::max(high[i], high[i + 1]));
            const int last = width - 1;
            out[last] = std::max(std::max(low[last], low[0]), std::max(high[last], high[0]));
        }
    });
    for (int k = 1; k < levels; ++k) {
        const ImageF& from = pyramid.levels.back();
        ImageF to(from.width / 2, from.height / 2, 1);
        parallel_for(to.height, 64, threads, [&](int begin, int end) {
            for (int j = begin; j < end; ++j) {
                const float* low = from.at(0, 2 * j);
                const float* high = from.at(0, 2 * j + 1);
                float* out = to.at(0, j);
                for (int i = 0; i < to.width; ++i)
                    out[i] = std::max(std::max(low[2 * i], low[2 * i + 1]), std::max(high[2 * i], high[2 * i + 1]));
            }
        });
        pyramid.levels.push_back(std::move(to));
    }
    return pyramid;
}

}  // namespace relievo
