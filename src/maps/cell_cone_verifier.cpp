#include "maps/cell_cone_verifier.h"

#include "core/error.h"
#include "core/map_set.h"
#include "core/parallel_for.h"
#include "core/wrap.h"

#include <algorithm>
#include <array>
#include <atomic>

namespace relievo {

namespace {

// The largest corner of each cell, or of the `count` cells from it on to larger or smaller i.
ImageF tops(const HeightField& field, int count, int step, int threads) {
    ImageF all(field.width(), field.height(), 1);
    parallel_for(field.height(), 16, threads, [&](int begin, int end) {
        std::vector<float> row(static_cast<std::size_t>(field.width()));
        for (int j = begin; j < end; ++j) {
            for (int i = 0; i < field.width(); ++i) row[static_cast<std::size_t>(i)] = std::max(field.wrapped(i, j), field.wrapped(i, j + 1));
            for (int i = 0; i < field.width(); ++i) {
                const int first = step > 0 ? i : i - count + 1;  // cells [first, first + count - 1] have texels up to first + count
                float top = 0;
                for (int k = 0; k <= count; ++k) top = std::max(top, row[static_cast<std::size_t>(wrap_index(first + k, field.width()))]);
                all(i, j) = top;
            }
        }
    });
    return all;
}

}  // namespace

Verification verify_cell_cone(const HeightField& field, const ImageF& stored, int threads) {
    constexpr std::array squares = {1, near_roof_reach + 1, middle_roof_reach + 1, far_roof_reach + 1};
    const int w = field.width();
    const int h = field.height();
    if (stored.width != w || stored.height != cell_cone_quadrants * h || stored.channels != static_cast<int>(squares.size()))
        throw Error("verify", "a cell cone map", "it was made for another field", "bake it anew from these heights");
    Verification all;
    std::atomic<std::uint64_t> violated = 0;
    for (const int step_x : {1, -1})
        for (std::size_t k = 0; k < squares.size(); ++k) {
            const ImageF along = tops(field, squares[k], step_x, threads);
            for (const int step_y : {1, -1}) {
                const int quadrant = (step_x < 0 ? 1 : 0) + (step_y < 0 ? 2 : 0);
                parallel_for(h, 16, threads, [&](int begin, int end) {
                    std::vector<char> below(static_cast<std::size_t>(w));
                    for (int j = begin; j < end; ++j) {
                        std::ranges::fill(below, 0);
                        const float* values = stored.at(0, quadrant * h + j) + k;
                        for (int d = 0; d < squares[k]; ++d) {
                            const float* top = along.at(0, wrap_index(j + step_y * d, h));
                            for (int i = 0; i < w; ++i) below[static_cast<std::size_t>(i)] |= static_cast<char>(values[i * stored.channels] < top[i]);
                        }
                        violated += static_cast<std::uint64_t>(std::ranges::count_if(below, [](char b) { return b != 0; }));
                    }
                });
                const auto cells = static_cast<std::uint64_t>(w) * static_cast<std::uint64_t>(h);
                const auto square = static_cast<std::uint64_t>(squares[k]);
                all.cones += cells;
                all.pairs += cells * square * square;
                all.checks += cells * square;
            }
            all.checks += static_cast<std::uint64_t>(w) * static_cast<std::uint64_t>(h) * static_cast<std::uint64_t>(squares[k] + 1);
        }
    all.violated = violated;
    return all;
}

}  // namespace relievo
