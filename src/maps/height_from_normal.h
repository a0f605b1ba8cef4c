// Heights from normals: the periodic surface whose slopes come nearest to the given ones in the least-squares sense,
// integrated in the frequency domain (Frankot & Chellappa 1988, "A method for enforcing integrability in shape from shading", eq. 21).
#pragma once

#include "core/height_field.h"
#include "core/progress.h"
#include "core/vec.h"

namespace relievo {

struct IntegratedHeight {
    HeightField height;       // spans exactly [0,1]; all 1 where the normals are flat
    float height_scale = 0;   // amplitude, in UV units, at which these heights have these normals; 0 for flat normals
    // Mean slopes dz/du and dz/dv, which no repeating surface can have; they were taken out. A map that tiles is near 0.
    Vec2f mean_slope;
    // Root mean square of the slope that no surface explains (the curl part), relative to that of the slopes; 0 = a true relief.
    float inconsistency = 0;
};

// normals: 3 channels, tangent space, +Y along +v, any length but 0, any size; repeated. Normals that lean more than 87 degrees, or
// backwards, are read as leaning 87 degrees, since a height field has no slope for them.
// Slopes are taken as those of the band-limited surface at the texel centres: exact for smooth reliefs.
IntegratedHeight height_from_normal(const ImageF& normals, int threads = 0, const Progress& progress = {});

}  // namespace relievo
