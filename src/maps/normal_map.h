// Normals of the relief from its heights (Blinn 1978): n = normalize(-s dh/du, -s dh/dv, 1), s the height_scale.
#pragma once

#include "core/height_field.h"

namespace relievo {

// Unit tangent-space normals at the texel centres, +Y along +v; 3 channels, the field's size.
// A bilinear surface has a crease at every texel centre: the slope there is the mean of the four patches that meet in it, which
// is the central difference dh/du = (h(i+1, j) - h(i-1, j)) w/2 (and likewise in v), with repeat addressing.
// height_scale is in UV units of the texture. threads: 0 means all cores; the result does not depend on it.
ImageF normal_map(const HeightField& field, float height_scale, int threads = 0);

}  // namespace relievo
