// How evenly strands cover a surface, and how much of it shares its strands with distant places: two measures taken the same way for
// every way of growing fur.
#pragma once

#include "core/mesh.h"
#include "fur/roots.h"

#include <cstdint>
#include <span>

namespace relievo {

struct EvennessSettings {
    double strands_per_disc = 64;    // expected in the discs that are counted: their radius follows from it
    std::uint32_t discs = 2000;      // placed evenly by area
    double distant = 0.1;            // in shares of `extent`: from where on places are no longer neighbours
    double extent = 0;               // radius of the bounding sphere, in the mesh's units; positive
    int threads = 0;
};

struct Evenness {
    double p5 = 0, p50 = 0, p95 = 0;    // strands per area in a disc, in units of the mean over the surface
    double density_p95_over_p5 = 0;     // infinite where a twentieth of the surface is bare
    double shared_texel_area = 0;       // share of the surface whose nearest strand also grows at a distant place
};

// `strands` tells for each root which strand of a texture it is a copy of; empty: each is its own.
// The disc around a point of the surface is what lies in a ball of that radius and looks the same way; its area is that of the
// triangles cut by the ball, exactly. Throws Error for a mesh without area. Does not depend on `threads`.
Evenness evenness(const Mesh& mesh, const Roots& roots, std::span<const std::uint32_t> strands, const EvennessSettings& settings);

// The area that the triangle shares with the ball around `centre`.
double area_in_ball(Vec3d a, Vec3d b, Vec3d c, Vec3d centre, double radius);

}  // namespace relievo
