// Faces that are none: corners at one place, no area, or a face that is there already.
#pragma once

#include "core/mesh.h"

#include <cstdint>
#include <vector>

namespace relievo {

struct FaceFaults {
    std::vector<std::uint32_t> places;      // per corner the first vertex at its position
    std::vector<std::uint8_t> collapsed;    // per face: two corners at one place
    std::vector<std::uint8_t> without_area; // per face: collapsed, or three corners on a line within rounding of the positions
    std::vector<std::uint8_t> repeated;     // per face, not collapsed: an earlier face has the same three places
};

FaceFaults face_faults(const Mesh& mesh, int threads = 0);

}  // namespace relievo
