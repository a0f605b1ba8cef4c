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
inline float arc_cosine(float x) {
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

// Of any face, however thin.
FaceDirections careful_directions(const Corners& c) {
    FaceDirections face;
    face.normal = unit(area_vector(c));
    const Vec3f a = unit(c.position[1] - c.position[0]), b = unit(c.position[2] - c.position[1]), d = unit(c.position[0] - c.position[2]);
    const float first = arc_cosine(-dot(a, d)), second = arc_cosine(-dot(a, b));
    face.angle = {first, second, std::max(0.0f, std::numbers::pi_v<float> - first - second)};
    return face;
}

// Faces whose directions are found together, number by number, so that the compiler can use vectors. Places that hold no face are
// computed with the others: every face goes through the same instructions, and its result is the same bits wherever it stands.
class FaceGroup {
public:
    static constexpr std::size_t size = 64;

    void put(std::size_t i, const Vec3f& p0, const Vec3f& p1, const Vec3f& p2) {
        x0_[i] = p0.x, y0_[i] = p0.y, z0_[i] = p0.z;
        x1_[i] = p1.x, y1_[i] = p1.y, z1_[i] = p1.z;
        x2_[i] = p2.x, y2_[i] = p2.y, z2_[i] = p2.z;
    }

    void find_directions(bool with_angles) {
        for (std::size_t i = 0; i < size; ++i) {
            const Vec3f a(x1_[i] - x0_[i], y1_[i] - y0_[i], z1_[i] - z0_[i]), b(x2_[i] - x1_[i], y2_[i] - y1_[i], z2_[i] - z1_[i]),
                d(x0_[i] - x2_[i], y0_[i] - y2_[i], z0_[i] - z2_[i]);
            const float a2 = dot(a, a), b2 = dot(b, b), d2 = dot(d, d);
            const Vec3f n = cross(d, a);
            const float n2 = dot(n, n);
            // Floats are good for all but thin faces (here below half a degree) and sizes whose fourth power leaves their range.
            const float smallest = std::min(a2, std::min(b2, d2)), largest = std::max(a2, std::max(b2, d2));
            good_[i] = (smallest > 1e-12f) & (largest < 1e12f) & (n2 > 1e-4f * a2 * d2) ? 1 : 0;
            const float l = std::sqrt(n2);
            nx_[i] = n.x / l, ny_[i] = n.y / l, nz_[i] = n.z / l;
            ad_[i] = -dot(a, d) / std::sqrt(a2 * d2);
            ab_[i] = -dot(a, b) / std::sqrt(a2 * b2);
        }
        if (!with_angles) return;
        for (std::size_t i = 0; i < size; ++i) {
            const float first = arc_cosine(ad_[i]), second = arc_cosine(ab_[i]);
            angle0_[i] = first;
            angle1_[i] = second;
            angle2_[i] = std::max(0.0f, std::numbers::pi_v<float> - first - second);
        }
    }

    // False where the face at i needs care.
    bool good(std::size_t i) const { return good_[i] != 0; }
    FaceDirections directions(std::size_t i) const { return {{nx_[i], ny_[i], nz_[i]}, {angle0_[i], angle1_[i], angle2_[i]}}; }

private:
    using Numbers = std::array<float, size>;
    Numbers x0_{}, y0_{}, z0_{}, x1_{}, y1_{}, z1_{}, x2_{}, y2_{}, z2_{};
    Numbers nx_{}, ny_{}, nz_{}, ad_{}, ab_{}, angle0_{}, angle1_{}, angle2_{};
    std::array<std::int32_t, size> good_{};
};

// The lowest and highest position that a block of faces touches: whoever owns none of them passes over the block.
constexpr std::size_t faces_per_block = 1024;
struct Reach {
    std::uint32_t low = 0xffffffff, high = 0;
};

std::vector<Reach> reaches(const Mesh& mesh, const std::vector<std::uint32_t>& place, int threads) {
    std::vector<Reach> reach((mesh.faces() + faces_per_block - 1) / faces_per_block);
    parallel_for(static_cast<int>(reach.size()), 32, threads, [&](int begin, int end) {
        for (auto b = static_cast<std::size_t>(begin); b < static_cast<std::size_t>(end); ++b)
            for (std::size_t i = 3 * b * faces_per_block; i < std::min(3 * (b + 1) * faces_per_block, mesh.indices.size()); ++i) {
                const std::uint32_t p = place[mesh.indices[i]];
                reach[b] = {std::min(reach[b].low, p), std::max(reach[b].high, p)};
            }
    });
    return reach;
}

// Adds to the positions in [begin, end) the normals of their faces, in the order of the faces, each by its angle or as it is.
void add_normals(const Mesh& mesh, const std::vector<std::uint32_t>& place, const std::vector<Reach>& reach, std::uint32_t begin, std::uint32_t end, bool by_angle,
                 std::vector<Vec3f>& normals) {
    FaceGroup group;
    std::array<std::uint32_t, FaceGroup::size> face;
    std::size_t count = 0;
    const auto add_group = [&] {
        group.find_directions(by_angle);
        for (std::size_t i = 0; i < count; ++i) {
            const FaceDirections d = group.good(i) ? group.directions(i) : careful_directions(corners_of(mesh, place, face[i]));
            for (std::size_t k = 0; k < 3; ++k)
                if (const std::uint32_t p = place[mesh.indices[face[i] * std::size_t{3} + k]]; p >= begin && p < end) normals[p] += by_angle ? d.normal * d.angle[k] : d.normal;
        }
        count = 0;
    };
    for (std::size_t b = 0; b < reach.size(); ++b) {
        if (reach[b].high < begin || reach[b].low >= end) continue;
        const bool all_mine = reach[b].low >= begin && reach[b].high < end;
        for (std::size_t f = b * faces_per_block; f < std::min((b + 1) * faces_per_block, mesh.faces()); ++f) {
            const std::uint32_t* const v = &mesh.indices[3 * f];
            if (!all_mine) {
                const auto mine = [&](std::uint32_t p) { return p - begin < end - begin; };
                if (!mine(place[v[0]]) && !mine(place[v[1]]) && !mine(place[v[2]])) continue;
            }
            group.put(count, mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]);
            face[count] = static_cast<std::uint32_t>(f);
            if (++count == FaceGroup::size) add_group();
        }
    }
    if (count > 0) add_group();
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
    return continuous_normals(mesh, mode, first_equal_vertex(mesh, Compared::positions, threads), threads);
}

std::vector<Vec3f> continuous_normals(const Mesh& mesh, NormalMode mode, const std::vector<std::uint32_t>& place, int threads) {
    assert(mode != NormalMode::none && place.size() == mesh.positions.size());
    const auto count = static_cast<std::uint32_t>(mesh.positions.size());
    std::vector<Vec3f> normals(count);
    if (count == 0) return normals;
    const std::vector<Reach> reach = mode == NormalMode::distinct ? std::vector<Reach>() : reaches(mesh, place, threads);
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
                    const Vec3f n = unit(area_vector(corners_of(mesh, place, around.face[i])));
                    if (dot(n, n) > 0 && distinct.is_new(n)) normals[p] += n;
                }
            }
        } else {
            add_normals(mesh, place, reach, begin, end, mode == NormalMode::angle, normals);
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
