#include "maps/pyramid_verifier.h"

#include "core/error.h"

#include <algorithm>

namespace relievo {

PyramidVerification verify_max_pyramid(const HeightField& field, const MaxPyramid& pyramid) {
    const int w = field.width();
    const int h = field.height();
    if (pyramid.cells_x != w || pyramid.cells_y != h || pyramid.levels.empty())
        throw Error("verify", "a pyramid of maxima", "it was made for another field", "bake it anew from these heights");
    PyramidVerification all;
    for (std::size_t k = 0; k < pyramid.levels.size(); ++k) {
        const ImageF& level = pyramid.levels[k];
        const int size = 1 << k;
        const int columns = (w + size - 1) / size;
        const int rows = (h + size - 1) / size;
        if (level.width < columns || level.height < rows)
            throw Error("verify", "a pyramid of maxima", "level " + std::to_string(k) + " has too few nodes", "bake it anew from these heights");
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                bool below = false;
                for (int b = 0; b < 2; ++b)
                    for (int a = 0; a < 2; ++a) {
                        ++all.checks;
                        if (k == 0) {
                            below |= level(i, j) < field.wrapped(i + a, j + b);
                        } else if (2 * i + a < (w + size / 2 - 1) / (size / 2) && 2 * j + b < (h + size / 2 - 1) / (size / 2)) {
                            below |= level(i, j) < pyramid.levels[k - 1](2 * i + a, 2 * j + b);
                        }
                    }
                ++all.nodes;
                all.cells += static_cast<std::uint64_t>(std::min(w, (i + 1) * size) - i * size) * static_cast<std::uint64_t>(std::min(h, (j + 1) * size) - j * size);
                all.violated += below;
            }
    }
    return all;
}

}  // namespace relievo
