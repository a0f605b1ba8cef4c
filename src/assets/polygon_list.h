// Polygons as a parser meets them: corner after corner, how many per face.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "assets/mesh_assembly.h"

namespace relievo {

struct PolygonList {
    std::vector<std::uint32_t> corners;
    std::vector<std::uint32_t> sizes;  // corners per face; empty while all are triangles
    std::size_t faces = 0;

    // Ends a face of the last `n` corners.
    void close(std::size_t n) {
        if (n != 3 && sizes.empty()) sizes.assign(faces, 3);
        if (n != 3 || !sizes.empty()) sizes.push_back(static_cast<std::uint32_t>(n));
        ++faces;
    }
};

// Three indices per triangle, all below positions.size(): polygons cut, broken faces left out and counted. Faces are taken in
// order, whatever the number of threads.
std::vector<std::uint32_t> triangles_of(PolygonList polygons, std::span<const Vec3f> positions, MeshFaults& faults, int threads);

// An index as files spell it: negative or too large is out of range.
inline std::uint32_t index_from(std::int64_t value) {
    return value < 0 || value >= static_cast<std::int64_t>(max_vertices) ? index_out_of_range : static_cast<std::uint32_t>(value);
}

}  // namespace relievo
