#include "mesh/repair.h"

#include "mesh/edges.h"
#include "mesh/face_faults.h"
#include "mesh/indexing.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace relievo {

namespace {

// Neighbours across edges of two faces, as (other face, must differ in orientation to agree).
struct Neighbours {
    std::vector<std::uint32_t> first;
    std::vector<std::pair<std::uint32_t, bool>> other;
};

Neighbours neighbours(std::span<const FaceSide> sides, std::size_t faces) {
    Neighbours n;
    n.first.assign(faces + 1, 0);
    const auto each_pair = [&](const auto& use) {
        each_edge(sides, [&](std::span<const FaceSide> edge) {
            if (edge.size() == 2 && edge[0].face != edge[1].face) use(edge[0].face, edge[1].face, edge[0].rising == edge[1].rising);
        });
    };
    each_pair([&](std::uint32_t a, std::uint32_t b, bool) { ++n.first[a + 1], ++n.first[b + 1]; });
    for (std::size_t f = 0; f < faces; ++f) n.first[f + 1] += n.first[f];
    n.other.resize(n.first.back());
    std::vector<std::uint32_t> at(n.first.begin(), n.first.end() - 1);
    each_pair([&](std::uint32_t a, std::uint32_t b, bool differ) {
        n.other[at[a]++] = {b, differ};
        n.other[at[b]++] = {a, differ};
    });
    return n;
}

// Twice the area, and six times the volume of the cone to the origin.
struct Extent {
    double area = 0, volume = 0;
};
Extent extent(const Mesh& mesh, std::uint32_t face) {
    const Vec3d a(mesh.positions[mesh.indices[face * std::size_t{3}]]), b(mesh.positions[mesh.indices[face * std::size_t{3} + 1]]),
        c(mesh.positions[mesh.indices[face * std::size_t{3} + 2]]);
    return {length(cross(b - a, c - a)), dot(a, cross(b, c))};
}

void orient(Mesh& mesh, const FaceFaults& faults, Repair& changed) {
    const std::size_t faces = mesh.faces();
    const std::vector<std::uint8_t> all(faces, 1);
    const std::vector<FaceSide> sides = sorted_sides(faults.places, all);
    const Neighbours near = neighbours(sides, faces);
    std::vector<std::uint8_t> open(faces, 0);  // has an edge of one face or of three and more
    each_edge(sides, [&](std::span<const FaceSide> edge) {
        if (edge.size() != 2)
            for (const FaceSide& s : edge) open[s.face] = 1;
    });
    std::vector<std::uint8_t> seen(faces, 0), turned(faces, 0);
    std::vector<std::uint32_t> piece;
    for (std::uint32_t start = 0; start < faces; ++start) {
        if (seen[start]) continue;
        piece.assign(1, start);
        seen[start] = 1;
        bool closed = true, agrees = true;
        double kept_area = 0, turned_area = 0, volume = 0;
        for (std::size_t i = 0; i < piece.size(); ++i) {
            const std::uint32_t f = piece[i];
            closed = closed && !open[f];
            const Extent e = extent(mesh, f);
            (turned[f] ? turned_area : kept_area) += e.area;
            volume += turned[f] ? -e.volume : e.volume;
            for (std::uint32_t k = near.first[f]; k < near.first[f + 1]; ++k) {
                const auto [g, differ] = near.other[k];
                const auto wanted = static_cast<std::uint8_t>(turned[f] ^ (differ ? 1 : 0));
                if (seen[g]) {
                    agrees = agrees && turned[g] == wanted;
                    continue;
                }
                seen[g] = 1;
                turned[g] = wanted;
                piece.push_back(g);
            }
        }
        // One-sided surfaces, Moebius' band say, cannot agree with themselves: whatever is turned, some edge stays wrong.
        if (!agrees) {
            for (const std::uint32_t f : piece) turned[f] = 0;
            continue;
        }
        bool other_way = turned_area > kept_area;
        if (closed && (other_way ? -volume : volume) < 0) {
            other_way = !other_way;
            ++changed.pieces_turned_out;
        }
        if (other_way)
            for (const std::uint32_t f : piece) turned[f] ^= 1;
    }
    for (std::size_t f = 0; f < faces; ++f) {
        if (!turned[f]) continue;
        ++changed.faces_turned;
        std::swap(mesh.indices[f * 3 + 1], mesh.indices[f * 3 + 2]);
    }
}

void note(Mesh& mesh, std::size_t count, const std::string& what) {
    if (count > 0) mesh.notes.push_back("repair: " + std::to_string(count) + " " + what);
}

}  // namespace

RepairedMesh repaired(Mesh mesh, int threads) {
    RepairedMesh result;
    Repair& changed = result.changed;
    FaceFaults faults = face_faults(mesh, threads);
    std::size_t kept = 0;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        changed.faces_collapsed += faults.collapsed[f];
        changed.faces_repeated += faults.repeated[f];
        if (faults.collapsed[f] || faults.repeated[f]) continue;
        for (std::size_t k = 0; k < 3; ++k) {
            mesh.indices[kept * 3 + k] = mesh.indices[f * 3 + k];
            faults.places[kept * 3 + k] = faults.places[f * 3 + k];
        }
        ++kept;
    }
    mesh.indices.resize(kept * 3);
    faults.places.resize(kept * 3);
    orient(mesh, faults, changed);

    const std::size_t before = mesh.positions.size();
    std::vector<std::uint8_t> used(before, 0);
    for (const std::uint32_t v : mesh.indices) used[v] = 1;
    changed.vertices_unreferenced = before - static_cast<std::size_t>(std::ranges::count(used, 1));
    mesh = indexed(std::move(mesh), threads);
    changed.vertices_merged = before - changed.vertices_unreferenced - mesh.positions.size();

    note(mesh, changed.faces_collapsed, "collapsed faces taken out");
    note(mesh, changed.faces_repeated, "repeated faces taken out");
    note(mesh, changed.faces_turned, "faces turned over");
    note(mesh, changed.pieces_turned_out, "closed pieces were inside out");
    note(mesh, changed.vertices_merged, "equal vertices merged");
    note(mesh, changed.vertices_unreferenced, "unused vertices taken out");
    result.mesh = std::move(mesh);
    return result;
}

}  // namespace relievo
