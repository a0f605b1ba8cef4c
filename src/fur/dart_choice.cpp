#include "fur/dart_choice.h"

#include "core/four_lanes.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace relievo {

namespace {

bool comes_before(const Root& p, const Root& q) {
    if (p.position.x != q.position.x) return p.position.x < q.position.x;
    if (p.position.y != q.position.y) return p.position.y < q.position.y;
    return p.position.z != q.position.z ? p.position.z < q.position.z : p.face < q.face;
}

// The sides that a disc reaches: all combinations of the steps it takes along each axis, single steps first.
struct Reached {
    std::uint8_t count = 0;
    std::array<std::uint8_t, 7> sides{};
};
constexpr std::array<Reached, 27> reached_sides = [] {
    std::array<Reached, 27> all{};
    for (int d = 0; d < 27; ++d) {
        const int dx = d % 3 - 1, dy = d / 3 % 3 - 1, dz = d / 9 - 1;
        Reached& r = all[static_cast<std::size_t>(d)];
        for (const int axes : {1, 2, 4, 3, 5, 6, 7})
            if ((!(axes & 1) || dx != 0) && (!(axes & 2) || dy != 0) && (!(axes & 4) || dz != 0))
                r.sides[r.count++] = static_cast<std::uint8_t>(dart_side(axes & 1 ? dx : 0, axes & 2 ? dy : 0, axes & 4 ? dz : 0));
    }
    return all;
}();

// The cell on a side of a cell: in which block of those around, and its number there.
struct Beside {
    std::uint8_t block = 0, cell = 0;
};
constexpr std::array<std::array<Beside, 27>, block_cells> beside_cells = [] {
    std::array<std::array<Beside, 27>, block_cells> all{};
    constexpr int side = static_cast<int>(block_side);
    const auto number = [](int x, int y, int z) { return cell_in_block(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z)); };
    const auto block = [](int v) { return v < 0 ? -1 : v >= side ? 1 : 0; };
    for (int cell = 0; cell < side * side * side; ++cell) {
        const int x = cell % side, y = cell / side % side, z = cell / (side * side);
        for (int d = 0; d < 27; ++d) {
            const int u = x + d % 3 - 1, v = y + d / 3 % 3 - 1, w = z + d / 9 - 1;
            all[number(x, y, z)][static_cast<std::size_t>(d)] = {static_cast<std::uint8_t>(dart_side(block(u), block(v), block(w))), static_cast<std::uint8_t>(number(u, v, w))};
        }
    }
    return all;
}();

// Of each cell, by which darts are sorted along x before they are compared one by one.
constexpr std::uint32_t slabs = 8;

const KeptDarts none;

}  // namespace

DartChoice::DartChoice(const DartGrid& grid, const Facings& facings, double distance)
    : grid_(grid), facings_(facings), near2_(static_cast<float>(distance * distance)) {}

void DartChoice::begin() { darts_.clear(); }

void DartChoice::add(std::span<const Root> darts) {
    constexpr float reach = 1 / cell_distances;
    const auto step = [](float inside) { return (inside > 1 - reach) - (inside < reach); };
    std::size_t to = darts_.size();
    darts_.resize(to + darts.size());
    Vec3f inside;
    for (const Root& dart : darts) {
        const Cell c = grid_.at(dart.position, inside);
        const auto slab = static_cast<std::uint32_t>(std::clamp(inside.x, 0.0f, 0.999f) * slabs);
        darts_[to++] = {dart, static_cast<std::uint16_t>(cell_in_block(c.x, c.y, c.z) * slabs + slab), static_cast<std::uint16_t>(dart_side(step(inside.x), step(inside.y), step(inside.z)))};
    }
}

bool DartChoice::faces_alike(const KeptDarts& kept, std::uint32_t first, std::uint32_t near, std::uint32_t face) const {
    for (; near != 0; near &= near - 1)
        if (facings_.alike(kept.face[first + static_cast<std::uint32_t>(std::countr_zero(near))], face)) return true;
    return false;
}

// Of its own cell, where those that are kept come from lower x on: from the last one back to where they are too far off.
bool DartChoice::taken_here(const Root& dart, std::uint32_t begin, std::uint32_t end) const {
    // The last look may reach back into the cells before, whose darts stay as well.
    for (std::uint32_t i = end; i > begin;) {
        i -= 4;
        const FourLanes x = four_from(&kept_.x[i]) - dart.position.x, y = four_from(&kept_.y[i]) - dart.position.y, z = four_from(&kept_.z[i]) - dart.position.z;
        const FourMask near = x * x + y * y + z * z < near2_;
        if (any(near) && faces_alike(kept_, i, bits_of(near), dart.face)) return true;
        if (i <= begin || x[0] * x[0] >= near2_) return false;
    }
    return false;
}

bool DartChoice::taken(const Root& dart, const KeptDarts& kept, KeptDarts::Range range) const {
    // The last look may reach into the cells that follow, whose darts stay as well.
    for (std::uint32_t i = range.begin; i < range.end; i += 4) {
        const FourLanes x = four_from(&kept.x[i]) - dart.position.x, y = four_from(&kept.y[i]) - dart.position.y, z = four_from(&kept.z[i]) - dart.position.z;
        const FourMask near = x * x + y * y + z * z < near2_;
        if (any(near) && faces_alike(kept, i, bits_of(near), dart.face)) return true;
    }
    return false;
}

KeptDarts DartChoice::choose(const std::array<const KeptDarts*, 27>& around) {
    // Cell by cell, in each by their place: darts come in the order of the file, and what stays must not depend on it. Among darts at one place, which is what repeated
    // faces throw, the first face's comes first.
    std::array<std::uint32_t, block_cells * slabs + 1> end{};
    for (const Dart& d : darts_) ++end[d.slab + 1u];
    for (std::uint32_t b = 0; b < block_cells * slabs; ++b) end[b + 1] += end[b];
    sorted_.resize(darts_.size());
    for (const Dart& d : darts_) sorted_[end[d.slab]++] = d;
    for (std::uint32_t b = 0, from = 0; b < block_cells * slabs; from = end[b++])
        if (end[b] > from + 1) std::sort(sorted_.begin() + from, sorted_.begin() + end[b], [](const Dart& p, const Dart& q) { return comes_before(p.root, q.root); });

    constexpr float far = std::numeric_limits<float>::infinity();
    const std::size_t room = darts_.size() + 2 * KeptDarts::padding;
    kept_.x.assign(room, far);
    kept_.y.assign(room, far);
    kept_.z.assign(room, far);
    kept_.face.resize(room);
    kept_.cells.fill({});
    std::array<const KeptDarts*, 27> blocks;
    for (std::size_t s = 0; s < 27; ++s) blocks[s] = s == dart_side(0, 0, 0) ? &kept_ : around[s] ? around[s] : &none;

    std::uint32_t count = KeptDarts::padding;
    for (std::uint32_t c = 0, i = 0; c < block_cells; ++c) {
        const std::uint32_t begin = count;
        for (const std::uint32_t last = end[c * slabs + slabs - 1]; i < last; ++i) {
            const Dart& dart = sorted_[i];
            bool free = !taken_here(dart.root, begin, count);
            const Reached& reached = reached_sides[dart.reach];
            for (std::uint32_t k = 0; k < reached.count && free; ++k) {
                const Beside b = beside_cells[c][reached.sides[k]];
                const KeptDarts& there = *blocks[b.block];
                free = !taken(dart.root, there, there.cells[b.cell]);
            }
            if (!free) continue;
            kept_.x[count] = dart.root.position.x;
            kept_.y[count] = dart.root.position.y;
            kept_.z[count] = dart.root.position.z;
            kept_.face[count++] = dart.root.face;
        }
        kept_.cells[c] = {begin, count};
    }
    const auto all = static_cast<std::ptrdiff_t>(count + KeptDarts::padding);
    return {{kept_.x.begin(), kept_.x.begin() + all}, {kept_.y.begin(), kept_.y.begin() + all}, {kept_.z.begin(), kept_.z.begin() + all}, {kept_.face.begin(), kept_.face.begin() + all}, kept_.cells};
}

}  // namespace relievo
