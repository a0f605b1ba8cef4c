#include "mesh/face_faults.h"

#include "mesh/equal_vertices.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace relievo {

namespace {

constexpr std::uint32_t empty = 0xffffffff;

using Places = std::array<std::uint32_t, 3>;

Places sorted_places(const FaceFaults& faults, std::size_t face) {
    Places p{faults.places[face * 3], faults.places[face * 3 + 1], faults.places[face * 3 + 2]};
    std::ranges::sort(p);
    return p;
}

std::size_t hash(const Places& p) {
    std::uint64_t h = 0;
    for (const std::uint32_t v : p) {
        h = (h ^ v) * 0x9e3779b97f4a7c15ull;
        h ^= h >> 32;
    }
    return h;
}

}  // namespace

FaceFaults face_faults(const Mesh& mesh, int threads) {
    FaceFaults faults;
    const std::vector<std::uint32_t> place = first_equal_vertex(mesh, Compared::positions, threads);
    faults.places.resize(mesh.indices.size());
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) faults.places[i] = place[mesh.indices[i]];
    faults.collapsed.resize(mesh.faces());
    faults.without_area.resize(mesh.faces());
    faults.repeated.resize(mesh.faces());

    const std::size_t slots = std::bit_ceil(mesh.faces() * 2 + 1);
    std::vector<std::uint32_t> table(slots, empty);
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const Places p = sorted_places(faults, f);
        if (p[0] == p[1] || p[1] == p[2]) {
            faults.collapsed[f] = faults.without_area[f] = 1;
            continue;
        }
        // Twice the area against the longest side: a height below the rounding of a float coordinate is none.
        const Vec3d a(mesh.positions[p[0]]), b(mesh.positions[p[1]]), c(mesh.positions[p[2]]);
        const double longest2 = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
        const double size = std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z), std::sqrt(longest2)});
        faults.without_area[f] = length(cross(b - a, c - a)) <= std::sqrt(longest2) * size * 0x1p-24;
        for (std::size_t slot = hash(p) & (slots - 1);; slot = (slot + 1) & (slots - 1)) {
            if (table[slot] == empty) {
                table[slot] = static_cast<std::uint32_t>(f);
                break;
            }
            if (sorted_places(faults, table[slot]) != p) continue;
            faults.repeated[f] = 1;
            break;
        }
    }
    return faults;
}

}  // namespace relievo
