// How far two surfaces are apart at worst.
#pragma once

#include "core/mesh.h"

#include <cstddef>

namespace relievo {

struct SurfaceDistance {
    double largest = 0;         // the larger of the next two: the (sampled) Hausdorff distance
    double from_first = 0;      // largest distance of a sample of the first surface from the second
    double from_second = 0;     // and the other way round
    double mean_from_first = 0;
    double mean_from_second = 0;
    double root_mean_square = 0;  // over the samples of both
    std::size_t samples = 0;      // taken on both together
};

// Samples are the vertices that faces use and points spread evenly over the area, about `samples` on each surface, at places that
// depend on the mesh alone; the distance of each is the exact distance to the nearest triangle of the other. What lies between
// samples is missed, so the true value is at least `largest`. Both meshes have faces. The result does not depend on `threads`.
// After Cignoni, Rocchini and Scopigno (1998), "Metro: Measuring Error on Simplified Surfaces", sampled both ways.
SurfaceDistance surface_distance(const Mesh& first, const Mesh& second, std::size_t samples = 100000, int threads = 0);

}  // namespace relievo
