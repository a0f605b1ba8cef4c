#include "mesh/normals.h"

#include "core/parallel_for.h"
#include "mesh/equal_vertices.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace relievo {

namespace {

// Two face normals are the same direction below about a tenth of a degree: triangles of one flat side differ by the rounding of
// their corners, those of a curved scan by far more.
constexpr float same_direction = 1.0f - 1.5e-6f;

struct Corners {
    std::array<std::uint32_t, 3> place;  // first vertex at each corner's position
    std::array<Vec3f, 3> position;
};

Corners corners_of(const Mesh& mesh, const std::vector<std::uint32_t>& place, std::size_t face) {
    Corners c;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh.indices[face * 3 + k];
        c.place[k] = place[v];
        c.position[k] = mesh.positions[v];
    }
    return c;
}

// Twice the area times the unit normal. In double where floats would lose the area of a thin or tiny face.
Vec3f area_vector(const Corners& c) { return Vec3f(cross(Vec3d(c.position[1]) - Vec3d(c.position[0]), Vec3d(c.position[2]) - Vec3d(c.position[0]))); }

// Within 3e-8 of the arc cosine: Abramowitz and Stegun, Handbook of Mathematical Functions, 4.4.46.
float arc_cosine(float x) {
    const float a = std::min(std::abs(x), 1.0f);
    const float p = ((((((-0.0012624911f * a + 0.0066700901f) * a - 0.0170881256f) * a + 0.0308918810f) * a - 0.0501743046f) * a + 0.0889789874f) * a -
                     0.2145988016f) * a + 1.5707963050f;
    const float r = std::sqrt(1.0f - a) * p;
    return x < 0 ? std::numbers::pi_v<float> - r : r;
}

// Sizes down to 1e-19 would square to nothing in float.
Vec3f unit(Vec3f v) {
    const float squared = dot(v, v);
    if (squared > 1e-30f && squared < 1e30f) return v / std::sqrt(squared);
    const double exact = length(Vec3d(v));
    return exact > 0 ? Vec3f(Vec3d(v) / exact) : Vec3f{};
}

// The unit normal and the interior angles, whose sum is half a turn, so that the third costs nothing.
struct FaceDirections {
    Vec3f normal;
    std::array<float, 3> angle;
};

FaceDirections directions(const Corners& c, bool with_angles) {
    const Vec3f a = c.position[1] - c.position[0], b = c.position[2] - c.position[1], d = c.position[0] - c.position[2];
    const float a2 = dot(a, a), b2 = dot(b, b), d2 = dot(d, d);
    const Vec3f n = cross(d, a);
    const float n2 = dot(n, n);
    FaceDirections face;
    // Floats are good for all but thin faces (here below half a degree) and sizes whose fourth power leaves their range.
    const float smallest = std::min({a2, b2, d2}), largest = std::max({a2, b2, d2});
    if (smallest > 1e-12f && largest < 1e12f && n2 > 1e-4f * a2 * d2) {
        face.normal = n / std::sqrt(n2);
        if (!with_angles) return face;
        const float first = arc_cosine(-dot(a, d) / std::sqrt(a2 * d2)), second = arc_cosine(-dot(a, b) / std::sqrt(a2 * b2));
        face.angle = {first, second, std::max(0.0f, std::numbers::pi_v<float> - first - second)};
        return face;
    }
    face.normal = unit(area_vector(c));
    const Vec3f ua = unit(a), ub = unit(b), ud = unit(d);
    const float first = arc_cosine(-dot(ua, ud)), second = arc_cosine(-dot(ua, ub));
    face.angle = {first, second, std::max(0.0f, std::numbers::pi_v<float> - first - second)};
    return face;
}

// Distinct normals of one position in order of their first face. Sixteen hold all but the wildest; more go to the heap.
struct DistinctNormals {
    std::vector<Vec3f> seen;
    bool is_new(Vec3f n) {
        for (const Vec3f& s : seen)
            if (dot(s, n) >= same_direction) return false;
        seen.push_back(n);
        return true;
    }
};

// For each position the faces around it, in their order: offsets into one list. For positions in [begin, end) only.
struct FacesAround {
    std::vector<std::uint32_t> offset, face;
};

FacesAround faces_around(const Mesh& mesh, const std::vector<std::uint32_t>& place, std::uint32_t begin, std::uint32_t end) {
    FacesAround around;
    around.offset.assign(end - begin + 2, 0);
    for (const std::uint32_t v : mesh.indices)
        if (const std::uint32_t p = place[v]; p >= begin && p < end) ++around.offset[p - begin + 2];
    for (std::size_t i = 2; i < around.offset.size(); ++i) around.offset[i] += around.offset[i - 1];
    around.face.resize(around.offset.back());
    for (std::size_t i = 0; i < mesh.indices.size(); ++i)
        if (const std::uint32_t p = place[mesh.indices[i]]; p >= begin && p < end)
            around.face[around.offset[p - begin + 1]++] = static_cast<std::uint32_t>(i / 3);
    return around;
}

}  // namespace

// Every thread owns a range of positions and walks through all faces, skipping those that touch none of its own. No position is
// written by two, and each is summed in the order of its faces, so the result is the same bits for any number of threads.
std::vector<Vec3f> continuous_normals(const Mesh& mesh, NormalMode mode, int threads) {
    assert(mode != NormalMode::none);
    const auto count = static_cast<std::uint32_t>(mesh.positions.size());
    std::vector<Vec3f> normals(count);
    if (count == 0) return normals;
    const std::vector<std::uint32_t> place = first_equal_vertex(mesh, Compared::positions, threads);
    const int workers = threads > 0 ? threads : default_threads();
    const int range = static_cast<int>((count + static_cast<std::uint32_t>(workers) - 1) / static_cast<std::uint32_t>(workers));

    parallel_for(static_cast<int>(count), range, threads, [&](int first, int last) {
        const auto begin = static_cast<std::uint32_t>(first), end = static_cast<std::uint32_t>(last);
        const auto mine = [&](std::uint32_t p) { return p >= begin && p < end; };
        if (mode == NormalMode::distinct) {
            const FacesAround around = faces_around(mesh, place, begin, end);
            DistinctNormals distinct;
            for (std::uint32_t p = begin; p < end; ++p) {
                distinct.seen.clear();
                for (std::uint32_t i = around.offset[p - begin]; i < around.offset[p - begin + 1]; ++i) {
                    const Vec3f n = directions(corners_of(mesh, place, around.face[i]), false).normal;
                    if (dot(n, n) > 0 && distinct.is_new(n)) normals[p] += n;
                }
            }
        } else {
            for (std::size_t f = 0; f < mesh.faces(); ++f) {
                const Corners c = corners_of(mesh, place, f);
                if (!mine(c.place[0]) && !mine(c.place[1]) && !mine(c.place[2])) continue;
                const FaceDirections face = directions(c, mode == NormalMode::angle);
                for (std::size_t k = 0; k < 3; ++k)
                    if (mine(c.place[k])) normals[c.place[k]] += mode == NormalMode::angle ? face.normal * face.angle[k] : face.normal;
            }
        }
        // What is left of unit normals that cancel is rounding; its direction would mean nothing.
        bool cancelled = false;
        for (std::uint32_t p = begin; p < end; ++p) {
            if (place[p] != p) continue;
            cancelled |= dot(normals[p], normals[p]) < 1e-10f;
            normals[p] = dot(normals[p], normals[p]) < 1e-10f ? Vec3f{} : unit(normals[p]);
        }
        if (!cancelled) return;
        std::vector<float> largest(end - begin);
        std::vector<Vec3f> its_normal(end - begin);
        for (std::size_t f = 0; f < mesh.faces(); ++f) {
            const Corners c = corners_of(mesh, place, f);
            for (const std::uint32_t p : c.place) {
                if (!mine(p) || !(normals[p] == Vec3f{})) continue;
                const Vec3f n = area_vector(c);
                if (length(n) <= largest[p - begin]) continue;
                largest[p - begin] = length(n);
                its_normal[p - begin] = unit(n);
            }
        }
        for (std::uint32_t p = begin; p < end; ++p)
            if (normals[p] == Vec3f{}) normals[p] = its_normal[p - begin];
    });
    parallel_for(static_cast<int>(count), 65536, threads, [&](int begin, int end) {
        for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v)
            if (place[v] != v) normals[v] = normals[place[v]];
    });
    return normals;
}

}  // namespace relievo
