#include "fur/refined.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <unordered_map>

namespace relievo {

namespace {

Mesh once(const Mesh& mesh) {
    Mesh fine;
    fine.name = mesh.name;
    fine.positions = mesh.positions;
    fine.normals = mesh.normals;
    fine.uvs = mesh.uvs;
    fine.colours = mesh.colours;
    fine.indices.reserve(mesh.indices.size() * 4);
    std::unordered_map<std::uint64_t, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, added] = middles.try_emplace(std::uint64_t{std::min(a, b)} << 32 | std::max(a, b), static_cast<std::uint32_t>(fine.positions.size()));
        if (added) {
            fine.positions.push_back((mesh.positions[a] + mesh.positions[b]) * 0.5f);
            const Vec3f sum = mesh.normals[a] + mesh.normals[b];
            const float l = length(sum);
            if (!mesh.uvs.empty()) fine.uvs.push_back((mesh.uvs[a] + mesh.uvs[b]) * 0.5f);
            if (!mesh.colours.empty()) fine.colours.push_back((mesh.colours[a] + mesh.colours[b]) * 0.5f);
            fine.normals.push_back(l > 1e-3f ? sum / l : mesh.normals[std::min(a, b)]);
        }
        return at->second;
    };
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
        fine.indices.insert(fine.indices.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    return fine;
}

}  // namespace

Mesh refined(Mesh mesh, std::size_t most) {
    assert(mesh.normals.size() == mesh.positions.size());
    while (mesh.faces() > 0 && mesh.faces() * 4 <= most) mesh = once(mesh);
    return mesh;
}

}  // namespace relievo
