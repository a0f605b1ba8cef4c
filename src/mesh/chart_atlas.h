// Texture coordinates for meshes that have none: charts seen along the axes, packed into a square.
#pragma once

#include "core/mesh.h"

#include <cstdint>
#include <vector>

namespace relievo {

struct ChartAtlas {
    Mesh mesh;                          // the faces in their order, with texture coordinates, its vertices doubled where charts part
    std::vector<std::uint32_t> vertex;  // of the mesh before, for each
    int size = 0, gutter = 0;           // texels a side, and around each chart
    int charts = 0;
    double texel = 0;                   // its width, in the mesh's units, before a face's slope stretches it: up to sqrt(3) times
};

// Faces that look along the same axis and hang together are a chart, projected along it; where a chart folds over itself its faces are
// parted, so that no texel's centre lies in two faces. Charts stand upright and are packed shelf by shelf (highest first) at one scale, the largest that fits
// within a few percent. `size` is at least 64. Throws Error where there are more charts than the square has room for.
ChartAtlas chart_atlas(const Mesh& mesh, int size, int threads = 0);

}  // namespace relievo
