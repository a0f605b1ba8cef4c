// Where the strands of a direction map grow on a mesh: what such fur is measured by.
#pragma once

#include "core/mesh.h"
#include "fur/direction_map.h"
#include "fur/roots.h"

#include <cstdint>
#include <vector>

namespace relievo {

struct MapStrands {
    Roots roots;                         // every place that looks up the middle of a texel with a strand; no `distance`
    std::vector<std::uint32_t> strands;  // of each root its texel: the row of all faces' texels
};

// The mesh has unit normals and its middle at the origin. Faces are cut until the directions at their corners are within 6 degrees of
// each other (seven times at most); within such a part they are taken to run straight, which for the normal or the position alone they
// do anyway. Does not depend on `threads`.
MapStrands map_strands(const Mesh& mesh, const DirectionMap& map, Addressing addressing, int threads = 0);

}  // namespace relievo
