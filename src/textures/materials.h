// The surfaces that the table in procedural.cpp names; one file each.
#pragma once

#include "textures/surface_function.h"

namespace relievo {

SurfaceFunction bricks(const Detail& detail);
SurfaceFunction cobbles(const Detail& detail);
SurfaceFunction spikes(const Detail& detail);
SurfaceFunction engraving(const Detail& detail);
SurfaceFunction dunes(const Detail& detail);

}  // namespace relievo
