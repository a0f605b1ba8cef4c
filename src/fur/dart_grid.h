// The grid by which darts find their neighbours: cells in space, and blocks of cells that one thread works on at a time.
#pragma once

#include "core/mesh.h"
#include "core/morton.h"

#include <algorithm>
#include <cstdint>

namespace relievo {

// A cell is six distances wide, so that a disc of one distance around a dart stays in it three times out of ten and else reaches into few others. A block of 4 x 4 x 4
// cells of a surface holds a few hundred darts, which stay in the nearest cache.
constexpr float cell_distances = 6;
constexpr std::uint32_t block_side = 4, block_cells = block_side * block_side * block_side;
constexpr std::uint32_t blocks_along_axis = 1u << morton_bits;

struct Cell {
    std::uint32_t x, y, z;
};

struct DartGrid {
    Vec3d low;  // of all darts
    double per_unit = 1;

    // The cell that holds p, and p from its low corner, in cells. Of cells so far from the low corner that blocks have no numbers left, all are one: more darts are compared
    // there. In double, because places far from the low corner are near others too, which single numbers would not tell.
    Cell at(Vec3f p, Vec3f& inside) const {
        constexpr double most = block_side * double{blocks_along_axis} - 1;
        const Vec3d q = (Vec3d(p) - low) * per_unit;
        const auto x = static_cast<std::int32_t>(std::min(q.x, most)), y = static_cast<std::int32_t>(std::min(q.y, most)), z = static_cast<std::int32_t>(std::min(q.z, most));
        inside = {static_cast<float>(q.x - x), static_cast<float>(q.y - y), static_cast<float>(q.z - z)};
        return {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z)};
    }
};

// Of a cell in its block, along the curve.
constexpr std::uint32_t cell_in_block(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return static_cast<std::uint32_t>(morton(x % block_side, y % block_side, z % block_side));
}

// A block by its place.
inline std::uint64_t block_of(Cell c) { return std::uint64_t{c.x / block_side} | std::uint64_t{c.y / block_side} << morton_bits | std::uint64_t{c.z / block_side} << 2 * morton_bits; }

// The same place as a number along the curve. Its three lowest bits say in which of eight groups the block is: no two blocks of a group touch.
inline std::uint64_t along_curve(std::uint64_t block) {
    constexpr std::uint64_t axis = blocks_along_axis - 1;
    return morton(block & axis, block >> morton_bits & axis, block >> 2 * morton_bits);
}

// The block beside one, both along the curve: each coordinate is counted up or down within its own bits.
inline std::uint64_t beside(std::uint64_t place, int dx, int dy, int dz) {
    const auto moved = [place](std::uint64_t bits, int d) {
        const std::uint64_t one = bits & -bits;
        return (d > 0 ? (place | ~bits) + one : d < 0 ? (place & bits) - one : place) & bits;
    };
    constexpr std::uint64_t every_third = morton_spread(blocks_along_axis - 1);
    return moved(every_third, dx) | moved(every_third << 1, dy) | moved(every_third << 2, dz);
}

}  // namespace relievo
