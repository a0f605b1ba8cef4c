#include "mesh/index_order.h"

#include "core/parallel_for.h"
#include "mesh/face_chunks.h"
#include "mesh/scored_order.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <meshoptimizer.h>
#include <numeric>
#include <span>
#include <vector>

namespace relievo {

namespace {

constexpr std::uint32_t unseen = 0xffffffff;

// A chunk in its new order, of vertices numbered by their first use in it.
struct ChunkOrder {
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> used;  // the vertex of the mesh for each number
};

std::vector<std::uint32_t> order_of(std::vector<std::uint32_t> indices, std::size_t vertices, const OrderSettings& settings) {
    const auto count = static_cast<std::uint32_t>(vertices);
    switch (settings.order) {
        case IndexOrder::none: break;
        case IndexOrder::meshopt: return scored_order(indices, count);
        case IndexOrder::fifo:
            meshopt_optimizeVertexCacheFifo(indices.data(), indices.data(), indices.size(), vertices, static_cast<unsigned>(settings.cache));
            break;
        case IndexOrder::lin_yu: return lin_yu_order(std::move(indices), count, settings.cache, settings.weights.value_or(lin_yu_weights(settings.cache)));
    }
    return indices;
}

// `number` has a place for every vertex of the mesh, all unseen, and is left like that.
ChunkOrder order_chunk(const Mesh& mesh, std::span<const std::uint32_t> faces, const OrderSettings& settings, std::vector<std::uint32_t>& number) {
    std::vector<std::uint32_t> vertices, indices(faces.size() * 3);
    vertices.reserve(faces.size() * 2 / 3);
    for (std::size_t f = 0; f < faces.size(); ++f)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = mesh.indices[faces[f] * std::size_t{3} + k];
            if (number[v] == unseen) {
                number[v] = static_cast<std::uint32_t>(vertices.size());
                vertices.push_back(v);
            }
            indices[f * 3 + k] = number[v];
        }
    for (const std::uint32_t v : vertices) number[v] = unseen;

    ChunkOrder chunk;
    chunk.indices = order_of(std::move(indices), vertices.size(), settings);
    chunk.used.reserve(vertices.size());
    std::vector<std::uint32_t> place(vertices.size(), unseen);
    for (std::uint32_t& v : chunk.indices) {
        if (place[v] == unseen) {
            place[v] = static_cast<std::uint32_t>(chunk.used.size());
            chunk.used.push_back(vertices[v]);
        }
        v = place[v];
    }
    return chunk;
}

template <class T>
void gather(std::vector<T>& values, const std::vector<std::uint32_t>& from, int threads) {
    if (values.empty()) return;
    std::vector<T> gathered(from.size());
    parallel_for(static_cast<int>(from.size()), 16384, threads, [&](int begin, int end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) gathered[i] = values[from[i]];
    });
    values = std::move(gathered);
}

}  // namespace

Mesh ordered(Mesh mesh, const OrderSettings& settings) {
    assert(settings.cache >= 4 && settings.cache <= 255);
    if (settings.order == IndexOrder::none || mesh.indices.empty()) return mesh;
    // Along cuts vertices are pushed twice: see docs/concepts/meshes.md for what chunks of each size cost.
    const std::uint32_t least_chunk = settings.least_chunk > 0 ? settings.least_chunk : 200000;
    const FaceChunks chunks = face_chunks(mesh, least_chunk, settings.threads);
    std::vector<ChunkOrder> orders(chunks.count());
    // The largest first, so that threads end together.
    std::vector<std::size_t> by_size(chunks.count());
    std::iota(by_size.begin(), by_size.end(), std::size_t{0});
    std::ranges::stable_sort(by_size, std::greater{}, [&](std::size_t c) { return chunks.begin[c + 1] - chunks.begin[c]; });
    parallel_for(static_cast<int>(chunks.count()), 1, settings.threads, [&](int begin, int end) {
        std::vector<std::uint32_t> number(mesh.positions.size(), unseen);
        for (int i = begin; i < end; ++i) {
            const std::size_t c = by_size[static_cast<std::size_t>(i)];
            orders[c] = order_chunk(mesh, std::span(chunks.faces).subspan(chunks.begin[c], chunks.begin[c + 1] - chunks.begin[c]), settings, number);
        }
    });

    // Vertices on a cut belong to the first chunk that uses them.
    std::vector<std::uint32_t> place(mesh.positions.size(), unseen), used;
    used.reserve(mesh.positions.size());
    for (ChunkOrder& chunk : orders)
        for (std::uint32_t& v : chunk.used) {
            if (place[v] == unseen) {
                place[v] = static_cast<std::uint32_t>(used.size());
                used.push_back(v);
            }
            v = place[v];
        }
    place = {};
    parallel_for(static_cast<int>(chunks.count()), 1, settings.threads, [&](int begin, int end) {
        for (auto c = static_cast<std::size_t>(begin); c < static_cast<std::size_t>(end); ++c) {
            std::uint32_t* out = &mesh.indices[chunks.begin[c] * std::size_t{3}];
            for (const std::uint32_t v : orders[c].indices) *out++ = orders[c].used[v];
            orders[c] = {};
        }
    });
    gather(mesh.positions, used, settings.threads);
    gather(mesh.normals, used, settings.threads);
    gather(mesh.uvs, used, settings.threads);
    gather(mesh.colours, used, settings.threads);
    return mesh;
}

}  // namespace relievo
