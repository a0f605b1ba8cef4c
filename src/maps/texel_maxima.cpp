#include "maps/texel_maxima.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <utility>

namespace relievo {

std::vector<ImageF> texel_maxima(const ImageF& texels, int least_levels, int threads) {
    std::vector<ImageF> levels{texels};
    while (levels.back().width > 1 || levels.back().height > 1 || static_cast<int>(levels.size()) < least_levels) {
        const ImageF& from = levels.back();
        ImageF to((from.width + 1) / 2, (from.height + 1) / 2, 1);
        parallel_for(to.height, 64, threads, [&](int begin, int end) {
            for (int j = begin; j < end; ++j)
                for (int i = 0; i < to.width; ++i) {
                    const int i1 = std::min(2 * i + 1, from.width - 1);
                    const int j1 = std::min(2 * j + 1, from.height - 1);
                    to(i, j) = std::max(std::max(from(2 * i, 2 * j), from(i1, 2 * j)), std::max(from(2 * i, j1), from(i1, j1)));
                }
        });
        levels.push_back(std::move(to));
    }
    return levels;
}

}  // namespace relievo
