#include "maps/cone_map.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace relievo {

namespace {

// (d/size)^2 for whole texel distances along one axis, unwrapped.
std::vector<float> squared_distances(int size) {
    std::vector<float> table(static_cast<std::size_t>(2 * size + 1));
    for (std::size_t d = 0; d < table.size(); ++d) {
        const float uv = static_cast<float>(d) / static_cast<float>(size);
        table[d] = uv * uv;
    }
    return table;
}

// Largest texel of blocks of 2^k x 2^k texels, up to a single node.
std::vector<ImageF> texel_maxima(const ImageF& texels) {
    std::vector<ImageF> levels{texels};
    while (levels.back().width > 1 || levels.back().height > 1) {
        const ImageF& from = levels.back();
        ImageF to((from.width + 1) / 2, (from.height + 1) / 2, 1);
        for (int j = 0; j < to.height; ++j)
            for (int i = 0; i < to.width; ++i) {
                const int i1 = std::min(2 * i + 1, from.width - 1);
                const int j1 = std::min(2 * j + 1, from.height - 1);
                to(i, j) = std::max(std::max(from(2 * i, 2 * j), from(i1, 2 * j)), std::max(from(2 * i, j1), from(i1, j1)));
            }
        levels.push_back(std::move(to));
    }
    return levels;
}

struct Node {
    int level, i, j;          // in the pyramid
    int origin_x, origin_y;   // of the repeat it is taken from, texels
};

}  // namespace

ImageF cone_map(const HeightField& field, int threads, const Progress& progress) {
    const int width = field.width();
    const int height = field.height();
    const std::vector<float> u2 = squared_distances(width);
    const std::vector<float> v2 = squared_distances(height);
    const std::vector<ImageF> maxima = texel_maxima(field.texels);
    ImageF cones(width, height, 2);

    const auto gap = [](int x, int low, int high) { return static_cast<std::size_t>(std::max({0, low - x, x - high})); };
    parallel_for(height, 1, threads, [&](int begin, int end) {
        std::vector<Node> open;
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < width; ++x) {
                const float h = field.texels(x, y);
                float q = 1.0f;
                open.clear();
                for (int b = -1; b <= 1; ++b)
                    for (int a = -1; a <= 1; ++a) open.push_back({static_cast<int>(maxima.size()) - 1, 0, 0, a * width, b * height});
                while (!open.empty()) {
                    const Node n = open.back();
                    open.pop_back();
                    const ImageF& level = maxima[static_cast<std::size_t>(n.level)];
                    const float rise = level(n.i, n.j) - h;
                    if (rise <= 0) continue;
                    const int low_x = n.origin_x + (n.i << n.level);
                    const int low_y = n.origin_y + (n.j << n.level);
                    const int high_x = n.origin_x + std::min(width, (n.i + 1) << n.level) - 1;
                    const int high_y = n.origin_y + std::min(height, (n.j + 1) << n.level) - 1;
                    const float d2 = u2[gap(x, low_x, high_x)] + v2[gap(y, low_y, high_y)];
                    const float bound = d2 / (rise * rise);
                    if (bound >= q) continue;
                    if (n.level == 0) {
                        q = bound;
                        continue;
                    }
                    const ImageF& below = maxima[static_cast<std::size_t>(n.level - 1)];
                    for (int b = 0; b < 2; ++b)
                        for (int a = 0; a < 2; ++a)
                            if (2 * n.i + a < below.width && 2 * n.j + b < below.height)
                                open.push_back({n.level - 1, 2 * n.i + a, 2 * n.j + b, n.origin_x, n.origin_y});
                }
                cones(x, y, 0) = h;
                cones(x, y, 1) = std::sqrt(q);
            }
    }, progress, "cone map");
    return cones;
}

}  // namespace relievo
