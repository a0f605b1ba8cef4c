#include "fur/fur_map.h"

#include <cassert>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

namespace relievo {

FurMap fur_map(const FurMapSettings& s) {
    assert(s.width > 0 && s.height > 0 && s.density >= 0 && s.density <= 1 && s.apart >= 0);
    const std::size_t count = static_cast<std::size_t>(s.width) * static_cast<std::size_t>(s.height);
    FurMap map;
    map.texels = Image8(s.width, s.height, 4, 255);
    for (std::size_t t = 0; t < count; ++t) map.texels.texels[t * 4 + 3] = 0;
    map.wanted = static_cast<std::uint32_t>(std::lround(s.density * static_cast<double>(count)));

    // A random order of all texels, those that are no longer free passed over, is what drawing until one is free amounts to. The generator's
    // numbers are the same everywhere, those of the library's distributions and shuffles are not.
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    std::mt19937 random(s.seed);
    std::vector<bool> blocked(s.apart > 0 ? count : 0, false);
    const int reach = static_cast<int>(s.apart);
    for (std::size_t i = 0; i < count && map.strands < map.wanted; ++i) {
        const std::size_t other = i + (std::uint64_t{random()} * (count - i) >> 32);
        std::swap(order[i], order[other]);
        const std::uint32_t texel = order[i];
        if (!blocked.empty()) {
            if (blocked[texel]) continue;
            const int x = static_cast<int>(texel) % s.width, y = static_cast<int>(texel) / s.width;
            for (int v = std::max(y - reach, 0); v <= std::min(y + reach, s.height - 1); ++v)
                for (int u = std::max(x - reach, 0); u <= std::min(x + reach, s.width - 1); ++u)
                    if ((u - x) * (u - x) + (v - y) * (v - y) <= s.apart * s.apart)
                        blocked[static_cast<std::size_t>(v) * static_cast<std::size_t>(s.width) + static_cast<std::size_t>(u)] = true;
        }
        map.texels.texels[std::size_t{texel} * 4 + 3] = 255;
        ++map.strands;
    }
    return map;
}

}  // namespace relievo
