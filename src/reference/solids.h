// All that a ray passes through below the declared bilinear surface, in double, by the reference's plain walk.
#pragma once

#include "core/frame.h"
#include "core/height_field.h"
#include "core/progress.h"
#include "core/ray_solids.h"
#include "reference/cast.h"

namespace relievo {

// Appends the ray's solids and their summary. What lies below z_end belongs to no solid; one that reaches it ends there.
void append_solids(RaySolids& all, const HeightField& field, const ReferenceRay& ray);

struct SolidSettings {
    float height_scale = 0.05f;
    float zero_level = 1;
    int threads = 0;  // 0: all cores; the result does not depend on it
};

// Of every ray that meets the polygon, over the whole slab from height 1 to 0; the others have none.
RaySolids reference_solids(const RayField& rays, const HeightField& field, const SolidSettings& settings, const Progress& progress = {});

}  // namespace relievo
