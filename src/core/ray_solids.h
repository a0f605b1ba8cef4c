// Everything that straight rays pass through under a surface: what a search could have found, not only the first of it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace relievo {

// A stretch of a descending ray inside the solid, as heights of the ray: enter >= leave.
struct Solid {
    float enter;
    float leave;
};

// One list of solids per ray, from the top down, of a picture's rays row by row; empty where there is nothing to find.
struct RaySolids {
    struct Ray {
        std::size_t first = 0;  // in `solids`
        std::size_t count = 0;
        // Least and greatest height of the surface over the ray's way from where it meets the polygon to its first solid.
        float lowest = 0;
        float highest = 0;
    };
    std::vector<Ray> rays;
    std::vector<Solid> solids;

    std::span<const Solid> of(std::size_t ray) const { return std::span(solids).subspan(rays[ray].first, rays[ray].count); }
};

}  // namespace relievo
