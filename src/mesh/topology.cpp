#include "mesh/topology.h"

#include "mesh/edges.h"
#include "mesh/equal_vertices.h"
#include "mesh/face_faults.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace relievo {

namespace {

std::size_t ones(const std::vector<std::uint8_t>& flags) { return static_cast<std::size_t>(std::ranges::count(flags, 1)); }

// Groups of what is marked, by representative.
std::size_t groups(Sets& sets, const std::vector<std::uint8_t>& marked) {
    std::size_t n = 0;
    for (std::uint32_t i = 0; i < marked.size(); ++i) n += marked[i] != 0 && sets.find(i) == i;
    return n;
}

}  // namespace

Topology topology(const Mesh& mesh, int threads) {
    Topology t;
    t.vertices = mesh.positions.size();
    t.faces = mesh.faces();
    std::vector<std::uint8_t> referenced(t.vertices, 0);
    for (const std::uint32_t v : mesh.indices) referenced[v] = 1;
    t.unreferenced_vertices = t.vertices - ones(referenced);
    const std::vector<std::uint32_t> first = first_equal_vertex(mesh, Compared::everything, threads);
    for (std::uint32_t v = 0; v < first.size(); ++v) t.duplicate_vertices += first[v] != v;

    const FaceFaults faults = face_faults(mesh, threads);
    t.degenerate_faces = ones(faults.without_area);
    t.duplicate_faces = ones(faults.repeated);
    std::vector<std::uint8_t> counted(t.faces);
    for (std::size_t f = 0; f < t.faces; ++f) counted[f] = !faults.collapsed[f];
    std::vector<std::uint8_t> place_used(t.vertices, 0);
    for (std::size_t i = 0; i < faults.places.size(); ++i)
        if (counted[i / 3]) place_used[faults.places[i]] = 1;
    t.distinct_positions = ones(place_used);

    // Corners of one place that are joined across edges form a fan; more than one fan at a place is a vertex that is not manifold.
    Sets pieces(t.faces), fans(mesh.indices.size()), loops(t.vertices);
    std::vector<std::uint8_t> on_boundary(t.vertices, 0);
    const std::vector<FaceSide> sides = sorted_sides(faults.places, counted);
    each_edge(sides, [&](std::span<const FaceSide> edge) {
        ++t.edges;
        for (const FaceSide& s : edge.subspan(1)) pieces.join(edge[0].face, s.face);
        if (edge.size() == 1) {
            ++t.boundary_edges;
            on_boundary[edge[0].low] = on_boundary[edge[0].high] = 1;
            loops.join(edge[0].low, edge[0].high);
        } else if (edge.size() > 2) {
            ++t.non_manifold_edges;
        } else if (edge[0].rising == edge[1].rising) {
            ++t.flipped_edges;
        }
        for (const FaceSide& s : edge.subspan(1))
            for (const bool at_low : {true, false}) {
                const auto corner = [&](const FaceSide& side) { return side.face * 3 + (at_low == side.rising ? side.corner : (side.corner + 1u) % 3); };
                fans.join(corner(edge[0]), corner(s));
            }
    });
    std::vector<std::uint8_t> fans_at(t.vertices, 0);
    for (std::uint32_t i = 0; i < mesh.indices.size(); ++i)
        if (counted[i / 3] && fans.find(i) == i) fans_at[faults.places[i]] = static_cast<std::uint8_t>(std::min(2, fans_at[faults.places[i]] + 1));
    t.non_manifold_vertices = static_cast<std::size_t>(std::ranges::count(fans_at, 2));
    t.holes = groups(loops, on_boundary);
    t.components = groups(pieces, counted);
    const std::size_t real_faces = ones(counted);
    t.closed = real_faces > 0 && t.boundary_edges == 0 && t.non_manifold_edges == 0;
    t.oriented = t.flipped_edges == 0;
    if (real_faces > 0)
        t.euler = static_cast<long>(t.distinct_positions) - static_cast<long>(t.edges) + static_cast<long>(real_faces);
    if (t.euler && t.non_manifold_edges == 0 && t.non_manifold_vertices == 0 && t.oriented)
        t.genus = (2 * static_cast<long>(t.components) - static_cast<long>(t.holes) - *t.euler) / 2;
    return t;
}

}  // namespace relievo
