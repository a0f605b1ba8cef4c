#include "assets/polygon_list.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <atomic>

namespace relievo {

std::vector<std::uint32_t> triangles_of(PolygonList polygons, std::span<const Vec3f> positions, MeshFaults& faults, int threads) {
    constexpr std::size_t block = 1 << 15;
    if (polygons.sizes.empty()) {
        std::atomic<bool> in_range{true};
        const std::size_t blocks = (polygons.corners.size() + block - 1) / block;
        parallel_for(static_cast<int>(blocks), 1, threads, [&](int first, int last) {
            const std::size_t begin = static_cast<std::size_t>(first) * block, end = std::min(polygons.corners.size(), static_cast<std::size_t>(last) * block);
            std::uint32_t largest = 0;
            for (std::size_t i = begin; i < end; ++i) largest = std::max(largest, polygons.corners[i]);
            if (largest >= positions.size()) in_range = false;
        });
        if (in_range) return std::move(polygons.corners);
    }
    std::vector<std::uint32_t> indices, places;
    indices.reserve(polygons.corners.size());
    PolygonCutter cutter;
    std::size_t first = 0;
    for (std::size_t f = 0; f < polygons.faces; ++f) {
        const std::size_t n = polygons.sizes.empty() ? 3 : polygons.sizes[f];
        places.clear();
        cutter.cut({polygons.corners.data() + first, n}, positions, places, faults);
        for (const std::uint32_t place : places) indices.push_back(polygons.corners[first + place]);
        first += n;
    }
    return indices;
}

}  // namespace relievo
