#include "mesh/indexing.h"

#include "core/parallel_for.h"
#include "mesh/equal_vertices.h"

#include <algorithm>

namespace relievo {

namespace {

constexpr std::uint32_t unused = 0xffffffff;

// values[new_place[v]] = values[v] for the vertices that stay. Places only move down, so it can be done where the values lie.
template <class T>
void compact(std::vector<T>& values, const std::vector<std::uint32_t>& kept) {
    if (values.empty()) return;
    for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
    values.resize(kept.size());
}

}  // namespace

Mesh indexed(Mesh mesh, int threads) {
    std::vector<std::uint32_t> place = first_equal_vertex(mesh, Compared::everything, threads);
    parallel_for(static_cast<int>(mesh.indices.size()), 262144, threads, [&](int begin, int end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) mesh.indices[i] = place[mesh.indices[i]];
    });
    std::fill(place.begin(), place.end(), unused);
    for (const std::uint32_t v : mesh.indices) place[v] = 0;
    std::vector<std::uint32_t> kept;
    kept.reserve(mesh.positions.size());
    for (std::uint32_t v = 0; v < place.size(); ++v) {
        if (place[v] == unused) continue;
        place[v] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(v);
    }
    if (kept.size() == mesh.positions.size()) return mesh;
    parallel_for(static_cast<int>(mesh.indices.size()), 262144, threads, [&](int begin, int end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) mesh.indices[i] = place[mesh.indices[i]];
    });
    compact(mesh.positions, kept);
    compact(mesh.normals, kept);
    compact(mesh.uvs, kept);
    compact(mesh.colours, kept);
    return mesh;
}

std::size_t vertex_bytes(const Mesh& mesh) {
    return sizeof(Vec3f) + (mesh.normals.empty() ? 0 : sizeof(Vec3f)) + (mesh.uvs.empty() ? 0 : sizeof(Vec2f)) +
           (mesh.colours.empty() ? 0 : sizeof(Vec3f));
}

std::size_t index_bytes(std::size_t vertices) { return vertices < 65536 ? 2 : 4; }

std::size_t list_bytes(const Mesh& mesh) { return mesh.indices.size() * vertex_bytes(mesh); }

std::size_t indexed_bytes(const Mesh& mesh) {
    return mesh.positions.size() * vertex_bytes(mesh) + mesh.indices.size() * index_bytes(mesh.positions.size());
}

}  // namespace relievo
