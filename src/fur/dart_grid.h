// The grid by which darts find their neighbours: cells in space, and blocks of cells that one thread works on at a time.
#pragma once

#include "core/mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace relievo {

// A cell is six distances wide, so that a disc of one distance around a dart stays in it three times out of ten and else reaches into few others. A block of 4 x 4 x 4
// cells of a surface holds some hundred darts, which stay in the nearest cache.
constexpr float cell_distances = 6;
constexpr std::uint32_t block_side = 4, block_cells = block_side * block_side * block_side;
constexpr std::uint32_t blocks_along_axis = 1u << 21;  // three coordinates in 63 bits

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

// Of a cell in its block: along Morton's curve (Morton 1966).
constexpr std::uint32_t cell_in_block(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const auto apart = [](std::uint32_t v) { return (v & 1) | (v & 2) << 2; };
    return apart(x) | apart(y) << 1 | apart(z) << 2;
}

// A block by its place.
inline std::uint64_t block_of(Cell c) { return std::uint64_t{c.x / block_side} | std::uint64_t{c.y / block_side} << 21 | std::uint64_t{c.z / block_side} << 42; }

// The same place as a number along Morton's curve, in whose order neighbours are mostly near each other. Its three lowest bits say in which of eight groups the block is:
// no two blocks of a group touch.
inline std::uint64_t along_curve(std::uint64_t block) {
    const auto apart = [](std::uint64_t v) {
        v = (v | v << 32) & 0x001f00000000ffffu;
        v = (v | v << 16) & 0x001f0000ff0000ffu;
        v = (v | v << 8) & 0x100f00f00f00f00fu;
        v = (v | v << 4) & 0x10c30c30c30c30c3u;
        return (v | v << 2) & 0x1249249249249249u;
    };
    constexpr std::uint64_t axis = blocks_along_axis - 1;
    return apart(block & axis) | apart(block >> 21 & axis) << 1 | apart(block >> 42) << 2;
}

// The block beside one, both along the curve: each coordinate is counted up or down within its own bits.
inline std::uint64_t beside(std::uint64_t place, int dx, int dy, int dz) {
    const auto moved = [place](std::uint64_t bits, int d) {
        const std::uint64_t one = bits & -bits;
        return (d > 0 ? (place | ~bits) + one : d < 0 ? (place & bits) - one : place) & bits;
    };
    constexpr std::uint64_t every_third = 0x1249249249249249u;
    return moved(every_third, dx) | moved(every_third << 1, dy) | moved(every_third << 2, dz);
}

// Numbers blocks from 0 as they come.
class BlockNumbers {
public:
    std::uint32_t operator()(std::uint64_t block) {
        if (!blocks_.empty() && block == blocks_[last_]) return last_;
        if (2 * blocks_.size() >= slots_.size()) grow();
        std::uint32_t& slot = slots_[find(block)];
        if (slot == 0) {
            blocks_.push_back(block);
            slot = static_cast<std::uint32_t>(blocks_.size());
        }
        return last_ = slot - 1;
    }
    const std::vector<std::uint64_t>& blocks() const { return blocks_; }
    void clear() {
        std::ranges::fill(slots_, 0u);
        blocks_.clear();
        last_ = 0;
    }

private:
    std::vector<std::uint64_t> blocks_;
    std::vector<std::uint32_t> slots_ = std::vector<std::uint32_t>(256);  // a number and 1; 0: none
    std::uint32_t last_ = 0;

    std::size_t find(std::uint64_t block) const {
        std::size_t at = block * 0x9e3779b97f4a7c15u >> 32 & (slots_.size() - 1);
        while (slots_[at] != 0 && blocks_[slots_[at] - 1] != block) at = (at + 1) & (slots_.size() - 1);
        return at;
    }
    void grow() {
        slots_.assign(slots_.size() * 2, 0);
        for (std::uint32_t n = 0; n < blocks_.size(); ++n) slots_[find(blocks_[n])] = n + 1;
    }
};

}  // namespace relievo
