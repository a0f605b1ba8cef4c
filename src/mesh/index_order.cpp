#include "mesh/index_order.h"

#include "core/parallel_for.h"
#include "mesh/face_chunks.h"

#include <algorithm>
#include <cassert>
#include <meshoptimizer.h>
#include <span>
#include <vector>

namespace relievo {

namespace {

constexpr std::uint32_t unseen = 0xffffffff;

// A chunk with vertices of its own numbers.
class ChunkOrder {
public:
    ChunkOrder(const Mesh& mesh, const OrderSettings& settings) : mesh_(mesh), settings_(settings), local_(mesh.positions.size(), unseen) {}

    void order(std::span<const std::uint32_t> faces, std::span<std::uint32_t> out) {
        global_.clear();
        indices_.resize(faces.size() * 3);
        for (std::size_t f = 0; f < faces.size(); ++f)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t v = mesh_.indices[faces[f] * 3 + k];
                if (local_[v] == unseen) {
                    local_[v] = static_cast<std::uint32_t>(global_.size());
                    global_.push_back(v);
                }
                indices_[f * 3 + k] = local_[v];
            }
        switch (settings_.order) {
            case IndexOrder::none: break;
            case IndexOrder::meshopt: meshopt_optimizeVertexCache(indices_.data(), indices_.data(), indices_.size(), global_.size()); break;
            case IndexOrder::fifo:
                meshopt_optimizeVertexCacheFifo(indices_.data(), indices_.data(), indices_.size(), global_.size(), static_cast<unsigned>(settings_.cache));
                break;
            case IndexOrder::lin_yu:
                indices_ = lin_yu_order(indices_, static_cast<std::uint32_t>(global_.size()), settings_.cache,
                                        settings_.weights.value_or(lin_yu_weights(settings_.cache)));
                break;
        }
        for (std::size_t i = 0; i < out.size(); ++i) out[i] = global_[indices_[i]];
        for (const std::uint32_t v : global_) local_[v] = unseen;
    }

private:
    const Mesh& mesh_;
    const OrderSettings& settings_;
    std::vector<std::uint32_t> local_;   // per vertex of the mesh its number in the chunk
    std::vector<std::uint32_t> global_;  // and back
    std::vector<std::uint32_t> indices_;
};

// Vertices in the order of first use.
Mesh in_order_of_use(Mesh mesh, int threads) {
    std::vector<std::uint32_t> place(mesh.positions.size(), unseen), used;
    used.reserve(mesh.positions.size());
    for (std::uint32_t& v : mesh.indices) {
        if (place[v] == unseen) {
            place[v] = static_cast<std::uint32_t>(used.size());
            used.push_back(v);
        }
        v = place[v];
    }
    const auto gather = [&](auto& values) {
        if (values.empty()) return;
        std::remove_reference_t<decltype(values)> gathered(used.size());
        parallel_for(static_cast<int>(used.size()), 65536, threads, [&](int begin, int end) {
            for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) gathered[i] = values[used[i]];
        });
        values = std::move(gathered);
    };
    gather(mesh.positions);
    gather(mesh.normals);
    gather(mesh.uvs);
    gather(mesh.colours);
    return mesh;
}

}  // namespace

Mesh ordered(Mesh mesh, const OrderSettings& settings) {
    assert(settings.cache >= 4 && settings.cache <= 255);
    if (settings.order == IndexOrder::none || mesh.indices.empty()) return mesh;
    // Along cuts vertices are pushed twice: see docs/concepts/meshes.md for what chunks of each size cost.
    const std::uint32_t least_chunk = settings.least_chunk > 0 ? settings.least_chunk : 200000;
    const FaceChunks chunks = face_chunks(mesh, least_chunk, settings.threads);
    std::vector<std::uint32_t> indices(mesh.indices.size());
    parallel_for(static_cast<int>(chunks.count()), 1, settings.threads, [&](int begin, int end) {
        ChunkOrder chunk_order(mesh, settings);
        for (auto c = static_cast<std::size_t>(begin); c < static_cast<std::size_t>(end); ++c) {
            const std::uint32_t from = chunks.begin[c], to = chunks.begin[c + 1];
            chunk_order.order(std::span(chunks.faces).subspan(from, to - from), std::span(indices).subspan(from * std::size_t{3}, (to - from) * std::size_t{3}));
        }
    });
    mesh.indices = std::move(indices);
    return in_order_of_use(std::move(mesh), settings.threads);
}

}  // namespace relievo
