#include "maps/quick_cone.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace relievo {

namespace {

struct Level {
    int size;  // texels of a block's side
    ImageF largest;
};

std::vector<Level> block_maxima(const ImageF& texels) {
    std::vector<Level> levels{{1, texels}};
    while (levels.back().largest.width > 1 || levels.back().largest.height > 1) {
        const ImageF& from = levels.back().largest;
        ImageF to((from.width + 1) / 2, (from.height + 1) / 2, 1, 0.0f);
        for (int j = 0; j < from.height; ++j)
            for (int i = 0; i < from.width; ++i) to(i / 2, j / 2) = std::max(to(i / 2, j / 2), from(i, j));
        levels.push_back({2 * levels.back().size, std::move(to)});
    }
    return levels;
}

// Block `first` + step along one axis: its index, and how many texels its nearest one is away from texel `at`.
struct Neighbour {
    int block;
    int distance;
};
Neighbour neighbour(int at, int step, int block_size, int blocks, int period) {
    const int own = at / block_size;
    if (step == 0) return {own, 0};
    if (step < 0) return own > 0 ? Neighbour{own - 1, at - own * block_size + 1} : Neighbour{blocks - 1, at + 1};
    return own + 1 < blocks ? Neighbour{own + 1, (own + 1) * block_size - at} : Neighbour{0, period - at};
}

}  // namespace

ImageF quick_cone(const HeightField& field, int threads) {
    const int w = field.width();
    const int h = field.height();
    const std::vector<Level> levels = block_maxima(field.texels);
    ImageF cones(w, h, 2);
    parallel_for(h, 16, threads, [&](int begin, int end) {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < w; ++x) {
                const float apex = field.texels(x, y);
                double ratio = 1;
                for (const Level& level : levels)
                    for (int k = 0; k < 9; ++k) {
                        if (k == 4) continue;
                        const Neighbour u = neighbour(x, k % 3 - 1, level.size, level.largest.width, w);
                        const Neighbour v = neighbour(y, k / 3 - 1, level.size, level.largest.height, h);
                        const double rise = static_cast<double>(level.largest(u.block, v.block)) - apex;
                        if (rise > 0) ratio = std::min(ratio, std::hypot(static_cast<double>(u.distance) / w, static_cast<double>(v.distance) / h) / rise);
                    }
                cones(x, y, 0) = apex;
                cones(x, y, 1) = static_cast<float>(ratio);
            }
    });
    return cones;
}

}  // namespace relievo
