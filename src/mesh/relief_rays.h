// The rays at which a relief on an unwrapped mesh is searched.
#pragma once

#include "core/camera.h"
#include "core/mesh_rays.h"
#include "mesh/charts.h"

namespace relievo {

struct ReliefRays {
    int width = 0, height = 0;
    Vec2d offset{0, 0};        // of the sample inside its pixel, from the centre, in pixels
    double repeats = 1;        // of the material over one unit of the mesh's UV
    double height_scale = 0;   // of the material, in UV units of a repeat: its relief is as high beside a repeat's mean edge on each chart
    double zero_level = 1;     // height at which the mesh lies
    bool ends_with_chart = true;  // a ray is searched while it stands over the chart it came from; else the picture goes on for ever
    const ImageF* beyond = nullptr;  // distances from the eye: only what lies farther is met; null: everything
    int threads = 0;
};

// Faces turned away are not met. The mesh has normals and uvs; faces without area in the picture are not met either.
MeshRays relief_rays(const Mesh& mesh, const Charts& charts, const Camera& camera, const ReliefRays& settings);

}  // namespace relievo
