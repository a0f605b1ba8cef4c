// Where a ray is inside the boxes that a hierarchical search asks for. A node is named inside one repeat of the field; the walk
// remembers how far the search has come, and so knows which repeat is meant.
#pragma once

#include "core/vec.h"

#include <vector>

namespace relievo {

struct Section;

// Along the section, in texels from the entry (Section's x).
struct BoxSpan {
    double enter = 0;
    double leave = 0;
};

class BoxWalk {
public:
    // Sizes of the height map, in texels.
    BoxWalk(const Section& section, int width, int height);

    BoxSpan node(Vec2i index, int level); // 2^level cells along an edge; inside one period
    BoxSpan ahead(int reach) const;       // from the last node's first cell to `reach` cells farther along either axis

private:
    // A cell that the ray passes over; `cell` is inside one period.
    struct Crossed {
        Vec2i cell;
        Vec2i moved;  // from the first cell
        double enter, leave;
    };
    Vec2d at_entry_;  // position over the cells where the ray enters the slab
    Vec2d step_;      // cells per texel of the section
    std::vector<Crossed> crossed_;
    std::size_t come_ = 0;
};

}  // namespace relievo
