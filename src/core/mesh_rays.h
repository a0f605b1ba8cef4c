// The rays of a picture of an unwrapped mesh: at each pixel the question that a search is asked on a flat base, and the frame in which
// its answer becomes a place and a normal of the mesh.
#pragma once

#include "core/frame.h"

#include <cstdint>
#include <vector>

namespace relievo {

// In the tangent plane of each pixel, whose normal is the mesh's interpolated one. A mesh is not unwrapped evenly, nor at right angles: what
// texture coordinate and height gain along a ray is exact for the pixel's face. `rays.view` and `height_scale` are chosen so that
//   view.xy * height_scale / view.z
// is the UV gained per height, as on a flat base; view.z is the true cosine to the normal.
struct MeshRays {
    RayField rays;        // coverage, uv (in repeats of the material), view, lod
    ImageF height_scale;  // 1 channel, UV units
    ImageF range;         // 2 channels: heights at which a search begins and ends; 1 and 0, or where the ray leaves the chart
    ImageF amplitude;     // 1 channel: height of the whole relief in the mesh's units, the same all over a chart
    ImageF position;      // 3 channels: where the ray meets the mesh
    ImageF to_eye;        // 3 channels, unit
    ImageF normal;        // 3 channels, unit
    ImageF along_u;       // 3 channels: gradients of u and v over the tangent plane, UV per unit of length
    ImageF along_v;
    ImageF distance;      // 1 channel, from the eye
    std::vector<std::uint32_t> face;  // of the mesh, row by row

    MeshRays() = default;
    MeshRays(int width, int height)
        : rays(width, height), height_scale(width, height, 1), range(width, height, 2), amplitude(width, height, 1), position(width, height, 3),
          to_eye(width, height, 3), normal(width, height, 3), along_u(width, height, 3), along_v(width, height, 3), distance(width, height, 1),
          face(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0xffffffff) {}
};

}  // namespace relievo
