#include "mesh/tangents.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace relievo {

namespace {

constexpr std::uint32_t none = 0xffffffff;

template <class T>
void repeat(std::vector<T>& values, std::uint32_t v) {
    if (!values.empty()) values.push_back(T(values[v]));
}

Vec3d in_plane(Vec3d v, Vec3d normal) { return v - normal * dot(v, normal); }

Vec3d unit_or(Vec3d v, Vec3d otherwise) { return dot(v, v) > 1e-300 ? v / length(v) : otherwise; }

// The axis least along n, made perpendicular to it.
Vec3d some_perpendicular(Vec3d n) {
    const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
    const Vec3d axis = x <= y && x <= z ? Vec3d(1, 0, 0) : y <= z ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1);
    return unit_or(in_plane(axis, n), {1, 0, 0});
}

struct FaceTexture {
    Vec3d along_u;        // unit; 0 where the texture has no area on the face
    int handedness = 0;  // +1 where u, v and the normal are right-handed, -1 where the texture is mirrored, 0 unknown
};

FaceTexture face_texture(const Mesh& mesh, const std::uint32_t* corner) {
    const Vec3d p(mesh.positions[corner[0]]), e1 = Vec3d(mesh.positions[corner[1]]) - p, e2 = Vec3d(mesh.positions[corner[2]]) - p;
    const Vec2d t(mesh.uvs[corner[0]]), f1 = Vec2d(mesh.uvs[corner[1]]) - t, f2 = Vec2d(mesh.uvs[corner[2]]) - t;
    const double area = f1.x * f2.y - f1.y * f2.x;
    if (area == 0 || !std::isfinite(area)) return {};
    FaceTexture face;
    face.handedness = area > 0 ? 1 : -1;
    face.along_u = unit_or((e1 * f2.y - e2 * f1.y) * (area > 0 ? 1.0 : -1.0), {});
    return face;
}

}  // namespace

TangentMesh with_tangents(Mesh mesh) {
    assert(mesh.normals.size() == mesh.positions.size() && mesh.uvs.size() == mesh.positions.size());
    const std::size_t before = mesh.positions.size();
    std::vector<FaceTexture> faces(mesh.faces());
    for (std::size_t f = 0; f < faces.size(); ++f) faces[f] = face_texture(mesh, &mesh.indices[f * 3]);

    // The first handedness met at a vertex keeps it, the other one gets a copy; faces that have none go with the former.
    std::vector<std::int8_t> hand(before, 0);
    std::vector<std::uint32_t> mirrored(before, none);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i)
        if (const std::uint32_t v = mesh.indices[i]; hand[v] == 0) hand[v] = static_cast<std::int8_t>(faces[i / 3].handedness);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
        const std::uint32_t v = mesh.indices[i];
        const int h = faces[i / 3].handedness;
        if (h == 0 || h == hand[v]) continue;
        if (mirrored[v] == none) {
            mirrored[v] = static_cast<std::uint32_t>(mesh.positions.size());
            repeat(mesh.positions, v);
            repeat(mesh.normals, v);
            repeat(mesh.uvs, v);
            repeat(mesh.colours, v);
            hand.push_back(static_cast<std::int8_t>(h));
        }
        mesh.indices[i] = mirrored[v];
    }

    std::vector<Vec3d> sums(mesh.positions.size());
    for (std::size_t f = 0; f < faces.size(); ++f) {
        if (faces[f].handedness == 0) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = mesh.indices[f * 3 + k];
            const Vec3d n(mesh.normals[v]), p(mesh.positions[v]);
            const Vec3d next = in_plane(Vec3d(mesh.positions[mesh.indices[f * 3 + (k + 1) % 3]]) - p, n);
            const Vec3d last = in_plane(Vec3d(mesh.positions[mesh.indices[f * 3 + (k + 2) % 3]]) - p, n);
            const double lengths = length(next) * length(last);
            if (!(lengths > 0)) continue;
            sums[v] += unit_or(in_plane(faces[f].along_u, n), {}) * std::acos(std::clamp(dot(next, last) / lengths, -1.0, 1.0));
        }
    }
    TangentMesh result;
    result.tangents.resize(mesh.positions.size());
    for (std::size_t v = 0; v < sums.size(); ++v) {
        const Vec3d n(mesh.normals[v]);
        const Vec3d t = dot(sums[v], sums[v]) > 1e-20 ? unit_or(in_plane(sums[v], n), some_perpendicular(n)) : some_perpendicular(n);
        result.tangents[v] = Vec4f(Vec3f(t), hand[v] < 0 ? -1.0f : 1.0f);
    }
    result.mesh = std::move(mesh);
    return result;
}

}  // namespace relievo
