// The charts of an unwrapped mesh: faces that hang together in the picture plane, and straight lines followed inside one of them.
#pragma once

#include "core/mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace relievo {

inline constexpr std::uint32_t no_face = 0xffffffff;

struct Charts {
    std::uint32_t count = 0;
    std::vector<std::uint32_t> of_face;                    // chart of each face
    std::vector<std::array<std::uint32_t, 3>> neighbours;  // across the edge from corner k to corner k + 1; no_face at the chart's edge
    std::vector<double> scale;                             // of each chart: length on the mesh per unit of UV, by area; 0 where it has none
};

// Faces are neighbours where they share an edge whose ends agree in position and texture coordinate (vertices may be doubled for other
// reasons) and the texture runs the same way round on both; an edge of three faces or more is an edge of the chart. Faces without area in
// the picture plane are charts of their own. The mesh has uvs.
Charts find_charts(const Mesh& mesh);

struct ChartWalk {
    std::uint32_t face = no_face;  // where the line ends: of its last point
    double share = 1;              // of the way that lies on the chart, in [0,1]
};

// Follows the straight line from `from`, which lies on `face` (or so near to it as rounding puts it), by `way` in UV, from face to face, until
// it ends or leaves the chart.
ChartWalk walk_chart(const Mesh& mesh, const Charts& charts, std::uint32_t face, Vec2d from, Vec2d way);

}  // namespace relievo
