// Small meshes whose every property can be said without a computer.
#pragma once

#include "core/mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace relievo::test {

inline Mesh mesh_of(std::vector<Vec3f> positions, std::vector<std::uint32_t> indices) {
    Mesh mesh;
    mesh.positions = std::move(positions);
    mesh.indices = std::move(indices);
    return mesh;
}

// [-1,1]^3 with eight vertices, two triangles a side, outwards.
inline Mesh cube() {
    std::vector<Vec3f> p;
    for (int i = 0; i < 8; ++i) p.emplace_back(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f);
    return mesh_of(p, {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5});
}

inline Mesh tetrahedron() { return mesh_of({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2}); }

// n x n squares of side 1 in the plane z = 0, all cut the same way, facing +z.
inline Mesh grid(std::uint32_t n) {
    Mesh mesh;
    for (std::uint32_t y = 0; y <= n; ++y)
        for (std::uint32_t x = 0; x <= n; ++x) mesh.positions.emplace_back(static_cast<float>(x), static_cast<float>(y), 0.0f);
    for (std::uint32_t y = 0; y < n; ++y)
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t a = y * (n + 1) + x, b = a + 1, c = a + n + 1, d = c + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
        }
    return mesh;
}

// Radii 1 and 0.4, around z, `around` x `across` squares, outwards.
inline Mesh torus(std::uint32_t around, std::uint32_t across) {
    Mesh mesh;
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t j = 0; j < across; ++j) {
            const double u = 2 * std::numbers::pi * i / around, v = 2 * std::numbers::pi * j / across;
            mesh.positions.emplace_back(static_cast<float>(std::cos(u) * (1 + 0.4 * std::cos(v))), static_cast<float>(std::sin(u) * (1 + 0.4 * std::cos(v))),
                                        static_cast<float>(0.4 * std::sin(v)));
        }
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return i % around * across + j % across; };
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t j = 0; j < across; ++j)
            mesh.indices.insert(mesh.indices.end(), {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    return mesh;
}

// An octahedron whose triangles are cut in four `levels` times, on the unit sphere: 8 * 4^levels faces.
inline Mesh sphere(int levels) {
    Mesh mesh = mesh_of({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
                        {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5});
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [it, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.positions.size()));
            if (fresh) mesh.positions.push_back(Vec3f(normalize(Vec3d(mesh.positions[a]) + Vec3d(mesh.positions[b]))));
            return it->second;
        };
        std::vector<std::uint32_t> finer;
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
            const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
            const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
        }
        mesh.indices = finer;
    }
    return mesh;
}

// Three vertices of its own for every face, as a list of faces has them.
inline Mesh as_list(const Mesh& mesh) {
    Mesh list;
    for (const std::uint32_t v : mesh.indices) {
        list.indices.push_back(static_cast<std::uint32_t>(list.positions.size()));
        list.positions.push_back(mesh.positions[v]);
        if (!mesh.normals.empty()) list.normals.push_back(mesh.normals[v]);
        if (!mesh.uvs.empty()) list.uvs.push_back(mesh.uvs[v]);
    }
    return list;
}

inline Mesh joined(Mesh a, const Mesh& b) {
    const auto offset = static_cast<std::uint32_t>(a.positions.size());
    a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
    for (const std::uint32_t v : b.indices) a.indices.push_back(v + offset);
    return a;
}

inline Mesh moved(Mesh mesh, Vec3f by) {
    for (Vec3f& p : mesh.positions) p += by;
    return mesh;
}

// Faces in a random order, each starting at a random corner, and vertices under random numbers: the same surface.
inline Mesh shuffled(const Mesh& mesh, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> number(mesh.positions.size());
    for (std::uint32_t v = 0; v < number.size(); ++v) number[v] = v;
    std::shuffle(number.begin(), number.end(), random);
    std::vector<std::array<std::uint32_t, 3>> faces;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const std::size_t k = random() % 3;
        faces.push_back({number[mesh.indices[f * 3 + k]], number[mesh.indices[f * 3 + (k + 1) % 3]], number[mesh.indices[f * 3 + (k + 2) % 3]]});
    }
    std::shuffle(faces.begin(), faces.end(), random);
    Mesh result;
    result.positions.resize(mesh.positions.size());
    for (std::size_t v = 0; v < number.size(); ++v) result.positions[number[v]] = mesh.positions[v];
    for (const auto& f : faces) result.indices.insert(result.indices.end(), f.begin(), f.end());
    return result;
}

// The faces as their corners' positions, each rotated to its least corner first, sorted: equal for equal surfaces of equal
// orientation, whatever their order and numbers.
inline std::vector<std::array<float, 9>> face_set(const Mesh& mesh) {
    std::vector<std::array<float, 9>> faces;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        std::array<float, 9> least{};
        for (std::size_t turn = 0; turn < 3; ++turn) {
            std::array<float, 9> face;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3f& p = mesh.positions[mesh.indices[f * 3 + (k + turn) % 3]];
                face[k * 3] = p.x;
                face[k * 3 + 1] = p.y;
                face[k * 3 + 2] = p.z;
            }
            if (turn == 0 || face < least) least = face;
        }
        faces.push_back(least);
    }
    std::ranges::sort(faces);
    return faces;
}

}  // namespace relievo::test
