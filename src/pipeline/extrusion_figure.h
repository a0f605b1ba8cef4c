// Why continuous normals come in three modes: a cube pushed out along each of them.
#pragma once

#include "figure/drawing.h"

namespace relievo {

// The cube of the 2009 thesis, two triangles a side, and what it becomes at three heights, side by side for the modes of
// mesh/normals.h; under each, how far its normals are from the cube's diagonals.
Drawing extrusion_figure();

}  // namespace relievo
