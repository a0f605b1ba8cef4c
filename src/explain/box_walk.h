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

    BoxSpan cell(Vec2i index);            // not wrapped
    BoxSpan node(Vec2i index, int level); // inside one period

private:
    // A cell that the ray passes over, inside one period.
    struct Crossed {
        Vec2i cell;
        double enter, leave;
    };
    Vec2d at_entry_;  // position over the cells where the ray enters the slab
    Vec2d step_;      // cells per texel of the section
    std::vector<Crossed> crossed_;
    std::size_t come_ = 0;
};

}  // namespace relievo
