// Relief on an unwrapped mesh, drawn by the CPU run of a technique's own text: one layer of surfaces, as the rays meet them.
#pragma once

#include "core/frame.h"
#include "core/lighting.h"
#include "core/map_set.h"
#include "core/mesh_rays.h"
#include "techniques/technique.h"

#include <functional>

namespace relievo {

// The share of a way in UV (in repeats, from a pixel's own place over a first way) that stays on the pixel's chart: for rays to lights, which
// nothing beyond the chart's edge can stop. Empty: all of it.
using ChartShare = std::function<double(int x, int y, Vec2d first, Vec2d way)>;

struct MeshReliefSettings {
    float zero_level = 1;
    float material_scale = 0.05f;  // height_scale with which the normal map was made
    bool shadow = true;            // hard, of the key light (the first), by the relief on itself; no face shadows another
    ChartShare on_chart = {};
    int threads = 0;
};

// Hits, fetches and shadows of a technique at its knobs, with the mesh's shading normals in world space and no colour. What is not met on
// the chart is no_hit: there the mesh has a hole, and something else may be seen through it.
Frame trace_mesh(const MeshRays& rays, const MapSet& maps, const Technique& technique, const MarchParams& params, const Lighting& lighting,
                 const MeshReliefSettings& settings);

// Phong's light (core/lighting.h) on hits from wherever: fills `colour` where there is one, from hit_uv, hit_height and shadow, and writes
// the world's normals of the normal map, or of the polygon where there is none.
void shade_mesh(Frame& hits, const MeshRays& rays, const MapSet& maps, ShadedBy shaded_by, const Lighting& lighting, const MeshReliefSettings& settings);

// A light's direction from a pixel's tangent plane, in the form of rays.view and the height_scale that goes with it; z <= 0: behind it.
struct PlaneLight {
    Vec3f toward;
    float height_scale = 0;
};
PlaneLight light_in_plane(const MeshRays& rays, int x, int y, const Light& light);

}  // namespace relievo
