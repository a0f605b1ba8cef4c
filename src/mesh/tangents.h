// Tangent frames for normal maps, per vertex.
#pragma once

#include "core/mesh.h"

#include <vector>

namespace relievo {

struct TangentMesh {
    Mesh mesh;                    // vertices whose faces disagree on the handedness are doubled
    std::vector<Vec4f> tangents;  // xyz: unit, perpendicular to the normal, along growing u; w: +1 or -1, bitangent = w cross(normal, tangent)
};

// The mesh has normals and uvs. Faces at a vertex count by their angle there, are projected into the plane of its normal first, and
// only faces of one handedness of the texture are averaged: the conventions of Mikkelsen (2008), "Simulation of Wrinkled Surfaces
// Revisited", so that maps baked for that basis fit. (Its welding of equal vertices is `indexed`; call it first.) Where the texture
// coordinates say nothing, or no face has area, the tangent is some unit vector perpendicular to the normal. Not thread dependent.
TangentMesh with_tangents(Mesh mesh);

}  // namespace relievo
