// Proves of a pyramid of maxima that no node lies below the surface it stands for. Independent of its baker.
#pragma once

#include "core/map_set.h"

#include <cstdint>

namespace relievo {

struct PyramidVerification {
    std::uint64_t nodes = 0;
    std::uint64_t cells = 0;     // (node, cell below it) pairs that follow
    std::uint64_t checks = 0;    // comparisons made for it
    std::uint64_t violated = 0;  // nodes below a corner of theirs, or below a node they were made of
};

// Level 0 against the four corners of its cells, every other level against the level below: by induction no node is below any
// corner of any of its cells. Throws Error where the pyramid does not belong to the field (sizes).
PyramidVerification verify_max_pyramid(const HeightField& field, const MaxPyramid& pyramid);

}  // namespace relievo
