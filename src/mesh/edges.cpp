#include "mesh/edges.h"

#include <algorithm>
#include <numeric>

namespace relievo {

// A bucket per lower place, then a sort of each bucket, which holds a handful.
std::vector<FaceSide> sorted_sides(std::span<const std::uint32_t> places, std::span<const std::uint8_t> counts) {
    std::uint32_t highest = 0;
    for (const std::uint32_t p : places) highest = std::max(highest, p);
    std::vector<std::uint32_t> bucket(std::size_t{highest} + 2);
    const auto each_side = [&](const auto& use) {
        for (std::uint32_t f = 0; f < counts.size(); ++f) {
            if (counts[f] == 0) continue;
            for (std::uint8_t k = 0; k < 3; ++k) {
                const std::uint32_t a = places[f * std::size_t{3} + k], b = places[f * std::size_t{3} + (k + 1) % 3];
                use(FaceSide{std::min(a, b), std::max(a, b), f, k, a < b});
            }
        }
    };
    each_side([&](const FaceSide& s) { ++bucket[s.low + 1]; });
    std::inclusive_scan(bucket.begin(), bucket.end(), bucket.begin());
    std::vector<FaceSide> sides(bucket.back());
    std::vector<std::uint32_t> at(bucket.begin(), bucket.end() - 1);
    each_side([&](const FaceSide& s) { sides[at[s.low]++] = s; });
    for (std::size_t b = 0; b + 1 < bucket.size(); ++b)
        std::stable_sort(sides.begin() + bucket[b], sides.begin() + bucket[b + 1], [](const FaceSide& a, const FaceSide& c) { return a.high < c.high; });
    return sides;
}

Sets::Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

std::uint32_t Sets::find(std::uint32_t a) {
    while (parent_[a] != a) a = parent_[a] = parent_[parent_[a]];
    return a;
}

void Sets::join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
}

}  // namespace relievo
