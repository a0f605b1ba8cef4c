// Stones of many sizes laid side by side on a torus, and the cell of each.
//
// Cells are those of a power diagram (Aurenhammer, "Power diagrams", SIAM J. Comput. 1987): a large stone pushes the border away
// from itself. Each site is a short segment instead of a point, so stones are longer than wide.
#pragma once

#include "core/vec.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relievo {

struct Stone {
    Vec2f centre;
    Vec2f half_axis;   // from the centre to one end of its core segment
    float radius;      // UV
    float per_length;  // 1 / squared length of half_axis; 0 for a round stone
    std::uint32_t id;  // random bits of its own
};

// A place among the stones.
struct StonePlace {
    int stone;        // index of the stone whose cell this is
    float inside;     // distance to the cell's border, UV, with corners rounded; at most the stone's radius
    float from_core;  // distance to the stone's core segment, UV
    Vec2f offset;     // from the stone's centre
};

class StonePacking {
public:
    // Stones with radii from `largest` down to `smallest`, thrown in that order until no more find room.
    StonePacking(float largest, float smallest, std::uint32_t seed);

    const std::vector<Stone>& stones() const { return stones_; }
    StonePlace at(Vec2f uv) const;

private:
    std::size_t owner(Vec2f uv) const;

    static constexpr int buckets = 24;
    std::vector<Stone> stones_;
    std::vector<std::vector<std::uint16_t>> owners_;      // per bucket: the stones that can own a place in it
    std::vector<std::vector<std::uint16_t>> neighbours_;  // per stone: those that shape its border
};

}  // namespace relievo
