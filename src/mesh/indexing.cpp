#include "mesh/indexing.h"

#include "core/parallel_for.h"
#include "mesh/equal_vertices.h"

#include <algorithm>
#include <cassert>

namespace relievo {

namespace {

// values[new_place[v]] = values[v] for the vertices that stay. Places only move down, so it can be done where the values lie.
template <class T>
void compact(std::vector<T>& values, const std::vector<std::uint32_t>& kept) {
    if (values.empty()) return;
    for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
    values.resize(kept.size());
}

}  // namespace

Mesh indexed(Mesh mesh, int threads) {
    const std::vector<std::uint32_t> first = first_equal_vertex(mesh, Compared::everything, threads);
    return indexed(std::move(mesh), first, threads);
}

Mesh indexed(Mesh mesh, const std::vector<std::uint32_t>& first, int threads) {
    assert(first.size() == mesh.positions.size());
    std::vector<std::uint8_t> used(first.size(), 0);
    for (const std::uint32_t v : mesh.indices) used[first[v]] = 1;
    const auto count = static_cast<std::size_t>(std::count(used.begin(), used.end(), std::uint8_t{1}));
    if (count == first.size()) return mesh;  // each is used, so each is the first of its kind
    std::vector<std::uint32_t> kept, place(first.size());
    kept.reserve(count);
    for (std::uint32_t v = 0; v < used.size(); ++v) {
        place[v] = used[v] ? static_cast<std::uint32_t>(kept.size()) : place[first[v]];
        if (used[v]) kept.push_back(v);
    }
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
