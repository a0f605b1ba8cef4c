// Which way fur lies.
#pragma once

#include "core/mesh.h"
#include "fur/painted_comb.h"

#include <span>
#include <vector>

namespace relievo {

// For each vertex a vector in the skin, at most 1 long: the way strands lean, and how strongly. Fur flows from the head to the tail and
// down; where the flow meets the skin head on it stands upright, so that there is no seam. The head is taken for the higher end of
// the longer horizontal axis (+y is up, as scanners have it). The mesh has unit normals (or none: (0,0,0)).
// `lean` is the angle from the normal, radians, at which fully combed strands stand in the mean: where a vertex's normal is far from those of
// its faces, as at the corners of a box, the comb is weaker, so that no strand leans into a face. 0: as if strands had no length.
// Where something is painted (empty: nowhere), it takes the flow's place by its weight.
std::vector<Vec3f> combed(const Mesh& mesh, float lean, int threads = 0, std::span<const PaintedLean> painted = {});

}  // namespace relievo
