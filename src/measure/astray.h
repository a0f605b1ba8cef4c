// The share of a picture's hits that are not where the technique promised.
#pragma once

#include "core/frame.h"
#include "core/measurement.h"
#include "core/promise.h"
#include "core/ray_solids.h"
#include "core/vec.h"

#include <functional>
#include <span>

namespace relievo {

// One ray: whether a hit at height z of the ray is not what the promise says. `solids` from the top down, not empty; `lowest` and
// `highest` bound the surface between polygon and first solid. texels_per_height: how far the ray moves per height; `rounding`:
// heights that float explains.
struct AstrayRay {
    std::span<const Solid> solids;
    double lowest = 0, highest = 0;
    double zero_level = 1;
    double texels_per_height = 0;
    double rounding = 0;
};
bool is_astray(const AstrayRay& ray, double z, const Promise& promise);

struct AstraySettings {
    Vec2i texels;            // of the height map
    double height_scale = 0;
    double zero_level = 1;
    std::function<Promise(double view_z)> promise;  // view_z: cosine of the view to the normal
    int threads = 0;
};

// Of the pixels whose ray has a solid (`truth` as reference_solids returns it for these rays). A pixel without a hit is astray.
Measured<double> astray_share(const Frame& picture, const RayField& rays, const RaySolids& truth, const AstraySettings& settings);

}  // namespace relievo
