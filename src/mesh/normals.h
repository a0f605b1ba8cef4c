// Continuous normals: one per distinct position, however many vertices a file or a seam of texture coordinates has put there. A
// closed mesh pushed out along them stays closed at any height, which is what layers of fur stand on.
#pragma once

#include "core/mesh.h"

#include <cstdint>
#include <string_view>
#include <vector>

namespace relievo {

enum class NormalMode {
    none,
    sum,       // of the unit normals of all faces at the position
    distinct,  // of the different ones among them, each counted once: the sides of an extruded cube stay straight
    angle,     // each face weighted by its angle at the position, so that the way a surface is cut into triangles does not matter
};

struct NormalModeEntry {
    NormalMode mode;
    std::string_view id;
    std::string_view summary;
};
inline constexpr NormalModeEntry normal_modes[] = {
    {NormalMode::none, "none", "leave the normals as the file has them"},
    {NormalMode::sum, "sum", "all faces at a position count alike"},
    {NormalMode::distinct, "distinct", "faces of equal normal count once: extruded cubes keep straight sides"},
    {NormalMode::angle, "angle", "faces count by their angle: independent of the triangulation"},
};

// A unit normal per vertex, equal bit for bit where positions are equal. Faces without area have no normal and do not count; where
// only such faces meet, or where the normals cancel, the normal is that of the largest face there, and (0,0,0) where no face has
// area. `mode` is not none. The result does not depend on `threads`.
// Sources: sum and distinct are the two algorithms of the 2009 thesis on fur for arbitrary meshes that the project started from;
// angle is Thuermer and Wuethrich (1998), "Computing Vertex Normals from Polygonal Facets".
std::vector<Vec3f> continuous_normals(const Mesh& mesh, NormalMode mode, int threads = 0);

// The same where first_equal_vertex of the positions is known.
std::vector<Vec3f> continuous_normals(const Mesh& mesh, NormalMode mode, const std::vector<std::uint32_t>& place, int threads = 0);

}  // namespace relievo
