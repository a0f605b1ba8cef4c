// How often pixels are shaded that something nearer covers afterwards.
#pragma once

#include "core/mesh.h"

namespace relievo {

// Pixels shaded per pixel covered when the mesh is drawn in its order with a depth test, mean over the six directions of the axes:
// 1 at best. By meshoptimizer's rasteriser. 0 for a mesh that covers nothing.
double overdraw(const Mesh& mesh);

}  // namespace relievo
