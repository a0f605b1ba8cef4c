#include "fur/comb.h"

#include "core/parallel_for.h"
#include "mesh/equal_vertices.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace relievo {

namespace {

// The horizontal way from head to tail.
Vec3f tailward(const Mesh& mesh) {
    Vec3d mean;
    for (const Vec3f& p : mesh.positions) mean += Vec3d(p);
    mean *= 1.0 / static_cast<double>(mesh.positions.size());
    double xx = 0, zz = 0, xy = 0, zy = 0;
    for (const Vec3f& p : mesh.positions) {
        const Vec3d d = Vec3d(p) - mean;
        xx += d.x * d.x;
        zz += d.z * d.z;
        xy += d.x * d.y;
        zy += d.z * d.y;
    }
    if (xx >= zz) return {xy > 0 ? -1.0f : 1.0f, 0, 0};
    return {0, 0, zy > 0 ? -1.0f : 1.0f};
}

}  // namespace

std::vector<Vec3f> combed(const Mesh& mesh, float lean, int threads, std::span<const PaintedLean> painted) {
    assert(mesh.normals.size() == mesh.positions.size() && (painted.empty() || painted.size() == mesh.positions.size()));
    const Vec3f flow = normalize(tailward(mesh) * 0.8f + Vec3f(0, -0.6f, 0));
    std::vector<Vec3f> combs(mesh.positions.size());
    parallel_for(static_cast<int>(combs.size()), 16384, threads, [&](int begin, int end) {
        for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
            const Vec3f n = mesh.normals[v], d = flow - n * dot(n, flow);
            // Full strength from 30 degrees off the flow's own direction.
            const float l = length(d);
            combs[v] = l > 0.5f ? d / l : d * 2.0f;
            if (painted.empty() || !(painted[v].weight > 0)) continue;
            // What was interpolated since it was painted may have left the skin.
            const Vec3f lean_here = painted[v].weighted - n * dot(n, painted[v].weighted);
            combs[v] = combs[v] * (1 - painted[v].weight) + lean_here;
        }
    });
    if (!(lean > 0)) return combs;
    // How far the normal of each place is from those of the faces there.
    const std::vector<std::uint32_t> place = first_equal_vertex(mesh, Compared::positions, threads);
    std::vector<float> cosine(mesh.positions.size(), 1);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Vec3f a = mesh.positions[mesh.indices[i]], n = cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
        const float size = length(n);
        if (!(size > 0)) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = mesh.indices[i + k];
            cosine[place[v]] = std::min(cosine[place[v]], dot(n, mesh.normals[v]) / size);
        }
    }
    constexpr float flat = 1.48f;  // 85 degrees: strands that lay in a face would flicker with it
    for (std::size_t v = 0; v < combs.size(); ++v) combs[v] *= std::clamp((flat - std::acos(std::clamp(cosine[place[v]], -1.0f, 1.0f))) / lean, 0.0f, 1.0f);
    return combs;
}

}  // namespace relievo
