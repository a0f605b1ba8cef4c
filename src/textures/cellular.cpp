#include "textures/cellular.h"

#include "textures/hash.h"

#include <cmath>

namespace relievo {

Cellular cellular(Vec2f uv, const CellularSpec& spec) {
    const float x = uv.x * static_cast<float>(spec.cells_u);
    const float y = uv.y * static_cast<float>(spec.cells_v);
    const int column = floor_index(x);
    const int line = floor_index(y);
    const Vec2f inside{x - static_cast<float>(column), y - static_cast<float>(line)};
    float first = 64;
    float second = 64;
    Cellular result{};
    for (int dj = -1; dj <= 1; ++dj) {
        const auto j = static_cast<std::uint32_t>(lattice_index(line + dj, spec.cells_v));
        const std::uint32_t row = scramble(spec.seed + j);
        for (int di = -1; di <= 1; ++di) {
            const auto i = static_cast<std::uint32_t>(lattice_index(column + di, spec.cells_u));
            const std::uint32_t h = scramble(row + i);
            // Two halves of one hash place the point.
            const Vec2f random{static_cast<float>(h & 0xffffu) / 65536.0f - 0.5f, static_cast<float>(h >> 16) / 65536.0f - 0.5f};
            const Vec2f point = Vec2f{static_cast<float>(di) + 0.5f, static_cast<float>(dj) + 0.5f} + random * (2 * spec.jitter);
            const Vec2f offset = inside - point;
            const float squared = dot(offset, offset);
            if (squared < first) {
                second = first;
                first = squared;
                result.offset = offset;
                result.id = scramble(h ^ 0x5bd1e995u);
            } else if (squared < second) {
                second = squared;
            }
        }
    }
    result.nearest = std::sqrt(first);
    result.second = std::sqrt(second);
    return result;
}

}  // namespace relievo
