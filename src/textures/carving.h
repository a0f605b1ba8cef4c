// Grooves cut into a plane: a set of figures, each with the section of its groove, searched through a grid.
#pragma once

#include "core/vec.h"

#include <cstdint>
#include <vector>

namespace relievo {

// The section of a groove from its edge inward: a near-sheer wall, then a sloping bed (V-cut) down to a floor.
struct Section {
    float wall = 0.4f;  // depth of the wall, in heights
    float slope = 0;    // depth gained per UV beyond the wall
    float floor = 1;    // greatest depth
};

// Figures in UV about the tile's centre, so that 0 is the middle.
struct Groove {
    enum class Figure : std::uint8_t {
        stem,  // a straight stroke from a to b with square ends, `width_a` to `width_b` wide (half), spread at the ends by flares
        ring,  // between two ellipses, only where x >= clip_x
        leaf,  // between two arcs that meet in a and b, `width_a` wide (half) in the middle
    };
    Figure figure = Figure::stem;
    Section section{};
    Vec2f a{}, b{};
    float width_a = 0, width_b = 0;
    float flare_a = 0, flare_b = 0;  // added half width at the very end
    float bracket = 0;               // length over which a flare dies out
    Vec2f centre{}, outer{}, inner_centre{}, inner{};
    float clip_x = -1;
};

// Signed distance to a groove's outline, UV, negative inside; first order away from it.
float groove_distance(const Groove& groove, Vec2f p);

struct Cut {
    float depth;     // 0 outside all grooves
    float distance;  // to the nearest outline, UV, negative inside; at most `reach`
};

class Carving {
public:
    explicit Carving(std::vector<Groove> grooves);

    // p in [-1/2, 1/2]^2; `wall_uv` is the horizontal extent of a wall; `ragged` moves every outline outward.
    Cut at(Vec2f p, float wall_uv, float ragged) const;

    static constexpr float reach = 0.008f;  // how far from an outline wear and dirt are still drawn

private:
    static constexpr int buckets = 48;
    std::vector<Groove> grooves_;
    std::vector<std::vector<std::uint16_t>> near_;
};

}  // namespace relievo
