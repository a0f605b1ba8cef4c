// How many vertices a machine has to compute for a mesh drawn in its order of indices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace relievo {

struct VertexWork {
    std::size_t vertices_computed = 0;
    double acmr = 0;  // computed per face: 3 at worst, about 0.5 at best on a large closed mesh
    double atvr = 0;  // computed per vertex that a face uses: 1 at best
};

// A cache that forgets the vertex that came in first; a hit does not move it. `cache` is its size in vertices, at least 3.
VertexWork fifo_work(std::span<const std::uint32_t> indices, std::size_t vertices, std::uint32_t cache);

// What a batch of vertices processed together may hold before the next one begins with nothing.
struct BatchModel {
    std::uint32_t vertices = 32;
    std::uint32_t faces = 32;
};

// Machines without a cache: they take faces as long as the batch holds, and compute each of its vertices once. The default is what
// Kerbl et al. (2018), "Revisiting the Vertex Cache: Understanding and Optimizing Vertex Processing on the Modern GPU", found on
// NVIDIA's. A batch holds at least one face.
VertexWork batched_work(std::span<const std::uint32_t> indices, std::size_t vertices, const BatchModel& model = {});

}  // namespace relievo
