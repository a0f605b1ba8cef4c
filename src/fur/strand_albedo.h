// The colour of a strand before light falls on it, as curves have it; the layers' programs say the same in their own words.
#pragma once

#include "fur/coat.h"
#include "fur/strand_curves.h"

namespace relievo {

// Linear light at `way` along the strand, 0 at the root and 1 at the tip: from the coat's root colour to its tip colour, varied from strand to
// strand, white for the grizzled ones, lighter where the skin looks down (countershading), and swaying with the lock.
Vec3d strand_albedo(const Coat& coat, const StrandCurves::Strand& strand, double way);

}  // namespace relievo
