#include "maps/cell_cone.h"

#include "core/map_set.h"
#include "core/parallel_for.h"
#include "core/wrap.h"
#include "maps/box_maximum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

// The squares ahead of a cell in the four quadrants are the same windows, entered at another corner: the maximum of the window that
// begins at (i, j) is the roof of cell (i, j) toward larger i and j, and of cell (i + reach, j) toward smaller i and larger j.

namespace relievo {

namespace {

// The least level not below.
float rounded_up(float x) {
    int k = static_cast<int>(std::ceil(x * 255.0 - 0.01));  // the float next to k/255 may lie on either side of it
    while (cell_cone_level(k) < x) ++k;
    return cell_cone_level(k);
}

}  // namespace

ImageF cell_cone_map(const HeightField& field, int threads, const Progress& progress) {
    const int width = field.width();
    const int height = field.height();
    ImageF highest(width, height, 1);
    parallel_for(height, 16, threads, [&](int begin, int end) {
        for (int j = begin; j < end; ++j)
            for (int i = 0; i < width; ++i) {
                const auto corners = field.cell(i, j);
                highest(i, j) = rounded_up(std::max(std::max(corners[0], corners[1]), std::max(corners[2], corners[3])));
            }
    });
    constexpr std::array reaches = {0, near_roof_reach, middle_roof_reach, far_roof_reach};
    std::array<ImageF, reaches.size()> windows;
    windows[0] = std::move(highest);
    for (std::size_t k = 1; k < reaches.size(); ++k) windows[k] = box_maximum(windows[0], reaches[k] + 1, threads);

    ImageF cones(width, cell_cone_quadrants * height, reaches.size());
    parallel_for(cones.height, 16, threads, [&](int begin, int end) {
        for (int row = begin; row < end; ++row) {
            const int quadrant = row / height;
            for (std::size_t k = 0; k < reaches.size(); ++k) {
                // A square wider than the field is all of it, wherever it begins.
                const int begin_x = (quadrant & 1) != 0 ? -reaches[k] : 0;
                const int begin_y = (quadrant & 2) != 0 ? -reaches[k] : 0;
                const float* from = windows[k].at(0, wrap_index(row % height + begin_y, height));
                float* to = cones.at(0, row) + k;
                int at = wrap_index(begin_x, width);
                for (int i = 0; i < width; ++i, to += reaches.size()) {
                    *to = from[at];
                    if (++at == width) at = 0;
                }
            }
        }
    }, progress, "cell cone map");
    return cones;
}

}  // namespace relievo
