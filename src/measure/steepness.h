// How steep a relief is as it is drawn.
#pragma once

#include "core/height_field.h"

namespace relievo {

// Root mean square over all texels of the slope between neighbours, both in UV units: 1 is 45 degrees. The field must not be empty.
double rms_slope(const HeightField& field, double height_scale);

}  // namespace relievo
