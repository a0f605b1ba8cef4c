#include "mesh/charts.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace relievo {

namespace {

// A corner as a chart sees it: where it is on the mesh and in the picture.
using Corner = std::tuple<float, float, float, float, float>;

double cross2(Vec2d a, Vec2d b) { return a.x * b.y - a.y * b.x; }

double uv_area(const Mesh& mesh, std::size_t face) {
    const std::uint32_t* c = &mesh.indices[face * 3];
    const Vec2d a(mesh.uvs[c[0]]);
    return 0.5 * cross2(Vec2d(mesh.uvs[c[1]]) - a, Vec2d(mesh.uvs[c[2]]) - a);
}

double area(const Mesh& mesh, std::size_t face) {
    const std::uint32_t* c = &mesh.indices[face * 3];
    const Vec3d a(mesh.positions[c[0]]);
    return 0.5 * length(cross(Vec3d(mesh.positions[c[1]]) - a, Vec3d(mesh.positions[c[2]]) - a));
}

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

}  // namespace

Charts find_charts(const Mesh& mesh) {
    assert(mesh.uvs.size() == mesh.positions.size());
    const std::size_t faces = mesh.faces();
    std::map<Corner, std::uint32_t> places;
    std::vector<std::uint32_t> place(mesh.positions.size());
    for (std::size_t v = 0; v < place.size(); ++v) {
        const Vec3f p = mesh.positions[v];
        const Vec2f t = mesh.uvs[v];
        // -0 and 0 are one place.
        place[v] = places.try_emplace({p.x + 0.0f, p.y + 0.0f, p.z + 0.0f, t.x + 0.0f, t.y + 0.0f}, static_cast<std::uint32_t>(places.size())).first->second;
    }
    struct Side {
        std::uint32_t face, edge;
    };
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Side>> sides;
    for (std::size_t f = 0; f < faces; ++f) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t a = place[mesh.indices[f * 3 + k]];
            const std::uint32_t b = place[mesh.indices[f * 3 + (k + 1) % 3]];
            sides[std::minmax(a, b)].push_back({static_cast<std::uint32_t>(f), k});
        }
    }
    Charts charts;
    charts.neighbours.assign(faces, {no_face, no_face, no_face});
    std::vector<std::uint32_t> parent(faces);
    std::iota(parent.begin(), parent.end(), 0u);
    for (const auto& [ends, at] : sides) {
        if (at.size() != 2 || ends.first == ends.second) continue;
        if (!(uv_area(mesh, at[0].face) * uv_area(mesh, at[1].face) > 0)) continue;
        charts.neighbours[at[0].face][at[0].edge] = at[1].face;
        charts.neighbours[at[1].face][at[1].edge] = at[0].face;
        parent[root_of(parent, at[0].face)] = root_of(parent, at[1].face);
    }
    charts.of_face.assign(faces, no_face);
    std::vector<double> on_mesh, in_picture;
    for (std::size_t f = 0; f < faces; ++f) {
        const std::uint32_t root = root_of(parent, static_cast<std::uint32_t>(f));
        if (charts.of_face[root] == no_face) {
            charts.of_face[root] = charts.count++;
            on_mesh.push_back(0);
            in_picture.push_back(0);
        }
        charts.of_face[f] = charts.of_face[root];
        on_mesh[charts.of_face[f]] += area(mesh, f);
        in_picture[charts.of_face[f]] += std::abs(uv_area(mesh, f));
    }
    for (std::size_t c = 0; c < charts.count; ++c) charts.scale.push_back(in_picture[c] > 0 ? std::sqrt(on_mesh[c] / in_picture[c]) : 0);
    return charts;
}

ChartWalk walk_chart(const Mesh& mesh, const Charts& charts, std::uint32_t face, Vec2d from, Vec2d way) {
    assert(face < mesh.faces());
    std::uint32_t came_through = 3;  // the edge the line entered by, which it does not leave by again
    double share = 0;
    // A line crosses each face of a chart at most once unless the chart overlaps itself; the bound only ends what rounding might repeat.
    for (std::size_t step = 0; step <= mesh.faces() + 3; ++step) {
        const std::uint32_t* corner = &mesh.indices[std::size_t{face} * 3];
        const double around = uv_area(mesh, face) < 0 ? -1 : 1;
        double leaves = 1;
        std::uint32_t through = 3;
        for (std::uint32_t k = 0; k < 3; ++k) {
            if (k == came_through) continue;
            const Vec2d a(mesh.uvs[corner[k]]);
            const Vec2d edge = Vec2d(mesh.uvs[corner[(k + 1) % 3]]) - a;
            const double outward = -around * cross2(edge, way);  // positive: the line approaches this edge from inside
            if (!(outward > 0)) continue;
            const double inside = around * cross2(edge, from - a);
            const double at = std::max(share, inside / outward);
            if (at < leaves) {
                leaves = at;
                through = k;
            }
        }
        if (through == 3) return {face, 1};
        const std::uint32_t next = charts.neighbours[face][through];
        if (next == no_face) return {face, leaves};
        share = leaves;
        came_through = 3;
        for (std::uint32_t k = 0; k < 3; ++k)
            if (charts.neighbours[next][k] == face) came_through = k;
        face = next;
    }
    return {face, share};
}

}  // namespace relievo
