#include "mesh/vertex_cache.h"

#include <cassert>
#include <vector>

namespace relievo {

namespace {

VertexWork work(std::size_t computed, std::size_t indices, std::size_t used) {
    if (indices == 0) return {};
    return {computed, 3.0 * static_cast<double>(computed) / static_cast<double>(indices), static_cast<double>(computed) / static_cast<double>(used)};
}

}  // namespace

VertexWork fifo_work(std::span<const std::uint32_t> indices, std::size_t vertices, std::uint32_t cache) {
    assert(cache >= 3);
    std::vector<std::uint64_t> entered(vertices, 0);  // the count of vertices computed up to and with this one; 0: never
    std::uint64_t computed = 0;
    std::size_t used = 0;
    for (const std::uint32_t v : indices) {
        used += entered[v] == 0;
        if (entered[v] == 0 || computed - entered[v] >= cache) entered[v] = ++computed;
    }
    return work(computed, indices.size(), used);
}

VertexWork batched_work(std::span<const std::uint32_t> indices, std::size_t vertices, const BatchModel& model) {
    assert(model.vertices >= 3 && model.faces >= 1);
    std::vector<std::uint32_t> last_batch(vertices, 0);  // in which the vertex was last computed; batches count from 1
    std::uint32_t batch = 1, held = 0, faces = 0;
    std::size_t computed = 0, used = 0;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
        const std::uint32_t missing = (last_batch[a] != batch) + (last_batch[b] != batch && b != a) + (last_batch[c] != batch && c != a && c != b);
        if (held + missing > model.vertices || faces == model.faces) {
            ++batch;
            held = faces = 0;
        }
        for (const std::uint32_t v : {a, b, c}) {
            used += last_batch[v] == 0;
            if (last_batch[v] == batch) continue;
            last_batch[v] = batch;
            ++held;
            ++computed;
        }
        ++faces;
    }
    return work(computed, indices.size(), used);
}

}  // namespace relievo
