// Proves of a cell cone map that no value lies below the surface of the cells it stands for. Independent of its baker.
#pragma once

#include "core/height_field.h"
#include "maps/cone_verifier.h"

namespace relievo {

// `stored` as maps/cell_cone.h defines it. Every value against the corners of every cell of its square: along the rows the largest of as
// many cells as the square is wide is taken one by one, and the value is compared with each of those of its rows. cones: values;
// pairs: (value, cell of its square); checks: comparisons. first and deepest are left out.
// Throws Error where the map does not belong to the field (sizes). threads: 0 means all cores.
Verification verify_cell_cone(const HeightField& field, const ImageF& stored, int threads = 0);

}  // namespace relievo
