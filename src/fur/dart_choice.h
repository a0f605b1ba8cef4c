// Which darts of a block stay: those that no earlier one is near.
#pragma once

#include "fur/dart_grid.h"
#include "fur/facing.h"
#include "fur/roots.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace relievo {

// The darts of a block that stay, cell by cell, in each by x.
struct KeptDarts {
    struct Range {
        std::uint32_t begin = 0, end = 0;
    };
    std::vector<float> x, y, z;       // before and behind them a few that are infinitely far, so that four can be looked at at a time
    std::vector<std::uint32_t> face;
    std::array<Range, block_cells> cells;

    std::uint32_t count() const { return cells.back().end - padding; }
    Root root(std::uint32_t i) const { return {{x[i + padding], y[i + padding], z[i + padding]}, face[i + padding]}; }
    static constexpr std::uint32_t padding = 4;
};

// One thread's; kept from block to block, so that its memory is.
class DartChoice {
public:
    DartChoice(const DartGrid& grid, const Facings& facings, double distance);

    // The block's darts come in any order. Of the 26 blocks around (see dart_side) those that are done, null for others; they may be read by several threads.
    void begin();
    void add(std::span<const Root> darts);
    KeptDarts choose(const std::array<const KeptDarts*, 27>& around);

private:
    struct Dart {
        Root root;
        std::uint16_t slab = 0;   // of its cell and block: each cell is cut into eight along x
        std::uint16_t reach = 0;  // which neighbours its disc reaches: dart_side of them all
    };
    const DartGrid& grid_;
    const Facings& facings_;
    float near2_;
    std::vector<Dart> darts_, sorted_;
    KeptDarts kept_;

    bool faces_alike(const KeptDarts& kept, std::uint32_t first, std::uint32_t near, std::uint32_t face) const;
    bool taken_here(const Root& dart, std::uint32_t begin, std::uint32_t end) const;
    bool taken(const Root& dart, const KeptDarts& kept, KeptDarts::Range range) const;
};

// A number from 0 to 26 for what lies one step away or none along each axis; 13 is the place itself.
constexpr std::uint32_t dart_side(int dx, int dy, int dz) { return static_cast<std::uint32_t>(dx + 1 + 3 * (dy + 1) + 9 * (dz + 1)); }

}  // namespace relievo
