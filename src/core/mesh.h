// A triangle mesh as every stage sees it: one record per vertex, three indices per face.
#pragma once

#include "core/vec.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace relievo {

// Whoever makes a Mesh keeps these promises, whoever takes one may rely on them:
// every position is finite, every index is below positions.size(), the three indices of a face are distinct, and an attribute is
// either empty or as long as `positions`. Vertices without faces, coinciding vertices and duplicate faces are allowed.
struct Mesh {
    std::string name;  // shown to people

    std::vector<Vec3f> positions;  // in the file's units and axes: formats seldom say which
    std::vector<Vec3f> normals;    // unit length; (0,0,0) at vertices for which the file gave none
    std::vector<Vec2f> uvs;        // v = 0 is the bottom of the picture; not confined to [0,1]; (0,0) where the file gave none
    std::vector<Vec3f> colours;    // RGB in [0,1], sRGB-encoded as scanners store them; white where the file gave none
    std::vector<std::uint32_t> indices;  // three per face, counter-clockwise seen from outside

    std::vector<std::string> notes;  // what was skipped, assumed or corrected on the way here, one sentence each, with counts

    std::size_t faces() const { return indices.size() / 3; }
};

}  // namespace relievo
