#include "fur/likeness.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

namespace relievo {

namespace {

// Roots sorted by the cells of a hash table.
class Near {
public:
    Near(const Roots& roots, double width) : roots_(roots), per_unit_(1 / width) {
        const std::size_t n = roots.roots.size();
        while (mask_ + 1 < n) mask_ = mask_ * 2 + 1;
        first_.assign(mask_ + 2, 0);
        std::vector<std::uint32_t> bucket(n);
        for (std::size_t i = 0; i < n; ++i) ++first_[(bucket[i] = bucket_of(cell(roots.roots[i].position))) + 1];
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        order_.resize(n);
        for (std::size_t i = 0; i < n; ++i) order_[next[bucket[i]]++] = static_cast<std::uint32_t>(i);
    }

    // The three nearest other roots, as far as they are in the cells around its own.
    std::array<std::uint32_t, 3> three(std::uint32_t own) const {
        struct Found {
            float gap2 = std::numeric_limits<float>::infinity();
            std::uint32_t root = none;
        };
        std::array<Found, 3> best{};
        const Vec3f p = roots_.roots[own].position;
        const std::array<std::int64_t, 3> c = cell(p);
        for (int k = 0; k < 27; ++k) {
            const std::array<std::int64_t, 3> at{c[0] + k % 3 - 1, c[1] + k / 3 % 3 - 1, c[2] + k / 9 - 1};
            const std::uint32_t b = bucket_of(at);
            for (std::uint32_t i = first_[b]; i < first_[b + 1]; ++i) {
                const std::uint32_t r = order_[i];
                // Buckets hold several cells: each root is met once, from its own.
                if (r == own || cell(roots_.roots[r].position) != at) continue;
                const Vec3f gap = roots_.roots[r].position - p;
                Found f{dot(gap, gap), r};
                for (Found& place : best)
                    if (f.gap2 < place.gap2) std::swap(f, place);
            }
        }
        return {best[0].root, best[1].root, best[2].root};
    }

    static constexpr std::uint32_t none = 0xffffffffu;

private:
    std::array<std::int64_t, 3> cell(Vec3f p) const {
        const auto at = [&](float v) { return static_cast<std::int64_t>(std::floor(static_cast<double>(v) * per_unit_)); };
        return {at(p.x), at(p.y), at(p.z)};
    }
    std::uint32_t bucket_of(const std::array<std::int64_t, 3>& c) const {
        return (static_cast<std::uint32_t>(c[0]) * 73856093u ^ static_cast<std::uint32_t>(c[1]) * 19349663u ^ static_cast<std::uint32_t>(c[2]) * 83492791u) & mask_;
    }
    const Roots& roots_;
    double per_unit_;
    std::uint32_t mask_ = 1;
    std::vector<std::uint32_t> first_, order_;
};

}  // namespace

std::vector<std::uint32_t> likeness(const Roots& roots, std::span<const std::uint32_t> chances, int threads) {
    assert(chances.size() == roots.roots.size());
    if (roots.roots.empty()) return {};
    // Nearest neighbours of a Poisson-disk sample are within two of its distances.
    const Near near(roots, 2 * roots.distance);
    std::vector<std::uint64_t> looks(chances.size());
    parallel_for(static_cast<int>(looks.size()), 4096, threads, [&](int begin, int end) {
        for (auto i = static_cast<std::uint32_t>(begin); i < static_cast<std::uint32_t>(end); ++i) {
            std::uint64_t look = chances[i] & 0xffffu;
            for (const std::uint32_t n : near.three(i)) look = look << 16 | (n == Near::none ? 0u : chances[n] & 0xffffu);
            looks[i] = look;
        }
    });
    std::vector<std::uint64_t> known(looks);
    std::ranges::sort(known);
    known.erase(std::unique(known.begin(), known.end()), known.end());
    std::vector<std::uint32_t> alike(looks.size());
    for (std::size_t i = 0; i < looks.size(); ++i) alike[i] = static_cast<std::uint32_t>(std::ranges::lower_bound(known, looks[i]) - known.begin());
    return alike;
}

}  // namespace relievo
