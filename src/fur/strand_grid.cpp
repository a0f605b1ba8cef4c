#include "fur/strand_grid.h"

#include "core/parallel_for.h"
#include "fur/facing.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>

namespace relievo {

namespace {

// In radii of the ball that holds what a point may find. Wider cells list more roots than are near, narrower ones repeat each in more lists.
constexpr float cell_width = 1.25f;

}  // namespace

std::uint32_t strand_chance(Vec3f root) {
    const auto word = [](float v) { return std::bit_cast<std::uint32_t>(v); };
    // Turned against each other: the signs of two coordinates are the top bits of their products and would cancel out, so that
    // places half a turn apart around an axis had one chance.
    std::uint32_t h = word(root.x) * 0x9e3779b1u ^ std::rotl(word(root.y) * 0x85ebca77u, 11) ^ std::rotl(word(root.z) * 0xc2b2ae3du, 21);
    h = (h ^ (h >> 16)) * 0x85ebca6bu;  // the finaliser of MurmurHash3
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return (h ^ (h >> 16)) >> 16;
}

std::uint32_t packed_normal(Vec3d n) {
    const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    if (!(sum > 0)) return 0x8080u;
    double x = n.x / sum, y = n.y / sum;
    if (n.z < 0) {
        const double fx = (1 - std::abs(y)) * (x < 0 ? -1 : 1), fy = (1 - std::abs(x)) * (y < 0 ? -1 : 1);
        x = fx;
        y = fy;
    }
    const auto eight = [](double v) { return static_cast<std::uint32_t>(std::clamp(v * 0.5 + 0.5, 0.0, 1.0) * 255 + 0.5); };
    return eight(x) | eight(y) << 8;
}

StrandGrid strand_grid(const Mesh& mesh, const Roots& roots, const GridSettings& settings) {
    assert(settings.reach > 0 && settings.off >= 0 && !roots.roots.empty());
    const int threads = settings.threads;
    // On a curved surface a point on it is off a root's plane, too.
    const float slack = settings.off + 0.3f * settings.reach;
    const float ball = std::sqrt(settings.reach * settings.reach + slack * slack);
    StrandGrid grid;
    grid.reach = settings.reach;
    grid.off = settings.off;
    grid.cells_per_unit = 1 / (cell_width * ball);
    const float per_unit = grid.cells_per_unit;
    Vec3f low = roots.roots[0].position, high = low;
    for (const Root& r : roots.roots) {
        low = {std::min(low.x, r.position.x), std::min(low.y, r.position.y), std::min(low.z, r.position.z)};
        high = {std::max(high.x, r.position.x), std::max(high.y, r.position.y), std::max(high.z, r.position.z)};
    }
    const float margin = 1.5f * ball;
    grid.low = low - Vec3f(margin);
    const Vec3f extent = (high - low + Vec3f(2 * margin)) * (per_unit / 8);
    grid.size = {static_cast<int>(extent.x) + 1, static_cast<int>(extent.y) + 1, static_cast<int>(extent.z) + 1};
    grid.bricks.assign(static_cast<std::size_t>(grid.size[0]) * static_cast<std::size_t>(grid.size[1]) * static_cast<std::size_t>(grid.size[2]), 0);

    const auto brick_of = [&](int x, int y, int z) {
        return static_cast<std::size_t>(x >> 3) + static_cast<std::size_t>(grid.size[0]) * (static_cast<std::size_t>(y >> 3) + static_cast<std::size_t>(grid.size[1]) * static_cast<std::size_t>(z >> 3));
    };
    // Calls visit(x, y, z, place in cells) for every cell that finds the root.
    const float r = ball * per_unit, near2 = r * r * 1.0001f;
    const auto each_cell = [&](const Root& root, const auto& visit) {
        const Vec3f p = (root.position - grid.low) * per_unit;
        const Vec3f n(face_vector(mesh, root.face));
        // A cell whose middle is farther from the tangent plane than half its extent along the normal, and what points may be off it.
        const float off = slack * per_unit * length(n) + 0.5f * (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
        const auto gap2 = [](float v, int c) {
            const auto at = static_cast<float>(c);
            const float g = v < at ? at - v : v > at + 1 ? v - at - 1 : 0;
            return g * g;
        };
        const int x0 = static_cast<int>(p.x - r), x1 = static_cast<int>(p.x + r);
        for (int z = static_cast<int>(p.z - r); z <= static_cast<int>(p.z + r); ++z)
            for (int y = static_cast<int>(p.y - r); y <= static_cast<int>(p.y + r); ++y) {
                const float yz2 = gap2(p.y, y) + gap2(p.z, z);
                if (yz2 > near2) continue;
                const float yz_off = (static_cast<float>(y) + 0.5f - p.y) * n.y + (static_cast<float>(z) + 0.5f - p.z) * n.z;
                for (int x = x0; x <= x1; ++x)
                    if (std::abs(yz_off + (static_cast<float>(x) + 0.5f - p.x) * n.x) <= off && yz2 + gap2(p.x, x) <= near2) visit(x, y, z, p);
            }
    };
    // Roots brick by brick: what they write then lies near each other in memory, which nearly halves the time.
    std::vector<std::uint32_t> first(grid.bricks.size() + 1, 0), order(roots.roots.size());
    const auto own_brick = [&](const Root& root) {
        const Vec3f p = (root.position - grid.low) * per_unit;
        return brick_of(static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z));
    };
    for (const Root& root : roots.roots) ++first[own_brick(root) + 1];
    for (std::size_t b = 0; b + 1 < first.size(); ++b) first[b + 1] += first[b];
    for (std::uint32_t i = 0; i < order.size(); ++i) order[first[own_brick(roots.roots[i])]++] = i;
    const auto each_root = [&](const auto& visit) {
        parallel_for(static_cast<int>(order.size()), 4096, threads, [&](int begin, int end) {
            for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) visit(roots.roots[order[i]]);
        });
    };

    // Balls are smaller than bricks: theirs are those of their boxes' corners.
    std::vector<std::atomic<bool>> used(grid.bricks.size());
    each_root([&](const Root& root) {
        const Vec3f p = (root.position - grid.low) * per_unit;
        for (int c = 0; c < 8; ++c) {
            const auto at = [&](float v, int bit) { return static_cast<int>(c & bit ? v + r : v - r); };
            auto& flag = used[brick_of(at(p.x, 1), at(p.y, 2), at(p.z, 4))];
            if (!flag.load(std::memory_order_relaxed)) flag.store(true, std::memory_order_relaxed);
        }
    });
    std::uint32_t count = 1;
    for (std::size_t b = 0; b < used.size(); ++b)
        if (used[b]) grid.bricks[b] = count++;

    const auto cell_of = [&](int x, int y, int z) { return grid.bricks[brick_of(x, y, z)] * std::size_t{512} + static_cast<std::size_t>((x & 7) | (y & 7) << 3 | (z & 7) << 6); };
    std::vector<std::atomic<std::uint32_t>> next(std::size_t{count} * 512);
    each_root([&](const Root& root) { each_cell(root, [&](int x, int y, int z, Vec3f) { next[cell_of(x, y, z)].fetch_add(1, std::memory_order_relaxed); }); });
    grid.starts.resize(next.size() + 1);
    std::uint32_t total = 0;
    for (std::size_t c = 0; c < next.size(); ++c) {
        grid.starts[c] = total;
        total += next[c].load(std::memory_order_relaxed);
        next[c].store(grid.starts[c], std::memory_order_relaxed);
    }
    grid.starts[next.size()] = total;
    grid.lists.resize(total);
    each_root([&](const Root& root) {
        const std::uint32_t own = packed_normal(face_vector(mesh, root.face)) | strand_chance(root.position) << 16;
        each_cell(root, [&](int x, int y, int z, Vec3f p) {
            const auto ten = [](float v, int cell) { return static_cast<std::uint32_t>(std::clamp((v - static_cast<float>(cell) + 1) * (1023.0f / 3), 0.0f, 1023.0f) + 0.5f); };
            grid.lists[next[cell_of(x, y, z)].fetch_add(1, std::memory_order_relaxed)] = {ten(p.x, x) | ten(p.y, y) << 10 | ten(p.z, z) << 20, own};
        });
    });
    // Threads put them in by chance.
    parallel_for(static_cast<int>(next.size()), 8192, threads, [&](int begin, int end) {
        for (auto c = static_cast<std::size_t>(begin); c < static_cast<std::size_t>(end); ++c) if (grid.starts[c + 1] - grid.starts[c] > 1) std::sort(grid.lists.begin() + grid.starts[c], grid.lists.begin() + grid.starts[c + 1]);
    });
    return grid;
}

}  // namespace relievo
