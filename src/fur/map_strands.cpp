#include "fur/map_strands.h"

#include "core/parallel_for.h"
#include "fur/facing.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace relievo {

namespace {

// Directions of strands, by the cell of a cube around them.
class Directions {
public:
    struct Strand {
        Vec3d way;
        std::uint32_t texel;
    };
    explicit Directions(const DirectionMap& map) : cells_(6 * cells * cells) {
        std::uint32_t texel = 0;
        for (int f = 0; f < static_cast<int>(map.faces.size()); ++f) {
            const Image8& face = map.faces[static_cast<std::size_t>(f)].front();
            for (int y = 0; y < face.height; ++y)
                for (int x = 0; x < face.width; ++x, ++texel) {
                    if (face(x, y, 3) == 0) continue;
                    const Vec3d way = map_direction(map.shape, {f, (x + 0.5) / face.width, (y + 0.5) / face.height});
                    const MapPoint p = map_point(MapShape::cube, way);
                    cells_[cell(p.face, static_cast<int>(p.u * cells), static_cast<int>(p.v * cells))].push_back({way, texel});
                }
        }
    }
    // Visits at least the strands within the triangle that the three directions span; they are near each other.
    template <class Visit>
    void each_in(const std::array<Vec3d, 3>& corners, const Visit& visit) const {
        for (int f = 0; f < 6; ++f) {
            double low_u = 1, high_u = 0, low_v = 1, high_v = 0;
            bool ahead = true;
            for (const Vec3d& c : corners) {
                const Vec3d n = normalize(c);
                const double along = f / 2 == 0 ? n.x : f / 2 == 1 ? n.y : n.z, away = f % 2 == 0 ? along : -along;
                // A face holds directions with 0.577 along its axis; corners within 6 degrees of one of them have 0.48.
                ahead = ahead && away > 0.3;
                if (!ahead) break;
                const Vec3d q = n / away;
                const double us[] = {-q.z, q.z, q.x, q.x, q.x, -q.x}, vs[] = {-q.y, -q.y, q.z, -q.z, -q.y, -q.y};
                const double u = 0.5 * (us[f] + 1), v = 0.5 * (vs[f] + 1);
                low_u = std::min(low_u, u);
                high_u = std::max(high_u, u);
                low_v = std::min(low_v, v);
                high_v = std::max(high_v, v);
            }
            if (!ahead || high_u < 0 || high_v < 0 || low_u > 1 || low_v > 1) continue;
            const auto place = [](double x) { return std::clamp(static_cast<int>(x * cells), 0, cells - 1); };
            for (int y = place(low_v); y <= place(high_v); ++y)
                for (int x = place(low_u); x <= place(high_u); ++x)
                    for (const Strand& s : cells_[cell(f, x, y)]) visit(s);
        }
    }

private:
    static constexpr int cells = 128;
    static std::size_t cell(int face, int x, int y) {
        return (static_cast<std::size_t>(face) * cells + static_cast<std::size_t>(std::min(y, cells - 1))) * cells + static_cast<std::size_t>(std::min(x, cells - 1));
    }
    std::vector<std::vector<Strand>> cells_;
};

struct Grown {
    Root root;
    std::uint32_t texel;
};

// One face: its corners, and parts of it by the weights of their corners.
struct Face {
    std::array<Vec3d, 3> positions, normals;
    Addressing addressing;
    Vec3d mean(const std::array<Vec3d, 3>& of, Vec3d w) const { return of[0] * w.x + of[1] * w.y + of[2] * w.z; }
    Vec3d way(Vec3d w) const { return addressed(addressing, mean(positions, w), mean(normals, w)); }

    template <class Visit>
    void parts(const std::array<Vec3d, 3>& weights, int depth, const Visit& visit) const {
        const std::array<Vec3d, 3> ways{way(weights[0]), way(weights[1]), way(weights[2])};
        double least = 1;
        for (std::size_t k = 0; k < 3; ++k) {
            const double l = length(ways[k]) * length(ways[(k + 1) % 3]);
            least = std::min(least, l > 1e-12 ? dot(ways[k], ways[(k + 1) % 3]) / l : -1.0);
        }
        constexpr double near = 0.9945;  // cosine of 6 degrees
        if (least >= near) return visit(weights, ways);
        if (depth == 7) return;  // directions turn about within a thousandth of the face: nothing can be seen of it
        const Vec3d a = weights[0], b = weights[1], c = weights[2], ab = (a + b) * 0.5, bc = (b + c) * 0.5, ca = (c + a) * 0.5;
        parts({a, ab, ca}, depth + 1, visit);
        parts({ab, b, bc}, depth + 1, visit);
        parts({ca, bc, c}, depth + 1, visit);
        parts({ab, bc, ca}, depth + 1, visit);
    }
};

}  // namespace

MapStrands map_strands(const Mesh& mesh, const DirectionMap& map, Addressing addressing, int threads) {
    assert(mesh.normals.size() == mesh.positions.size());
    const Directions directions(map);
    constexpr int grain = 4096;
    std::vector<std::vector<Grown>> blocks((mesh.faces() + grain - 1) / grain);
    parallel_for(static_cast<int>(mesh.faces()), grain, threads, [&](int begin, int end) {
        std::vector<Grown>& mine = blocks[static_cast<std::size_t>(begin / grain)];
        for (auto f = static_cast<std::uint32_t>(begin); f < static_cast<std::uint32_t>(end); ++f) {
            Face face{{}, {}, addressing};
            for (std::size_t k = 0; k < 3; ++k) {
                face.positions[k] = Vec3d(mesh.positions[mesh.indices[f * std::size_t{3} + k]]);
                face.normals[k] = Vec3d(mesh.normals[mesh.indices[f * std::size_t{3} + k]]);
            }
            if (!(length(face_vector(mesh, f)) > 0)) continue;
            face.parts({{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, 0, [&](const std::array<Vec3d, 3>& weights, const std::array<Vec3d, 3>& ways) {
                // The direction d is w0 s0 + w1 s1 + w2 s2 with no weight negative: by Cramer's rule, up to a common factor.
                const Vec3d c0 = cross(ways[1], ways[2]), c1 = cross(ways[2], ways[0]), c2 = cross(ways[0], ways[1]);
                const double all = dot(ways[0], c0);
                if (!(std::abs(all) > 1e-14)) return;  // one direction, or a line of them: no area of the map
                directions.each_in(ways, [&](const Directions::Strand& s) {
                    const double w0 = dot(s.way, c0) / all, w1 = dot(s.way, c1) / all, w2 = dot(s.way, c2) / all;
                    if (!(w0 >= 0 && w1 >= 0 && w2 >= 0)) return;
                    const Vec3d at = (weights[0] * w0 + weights[1] * w1 + weights[2] * w2) / (w0 + w1 + w2);
                    mine.push_back({{Vec3f(face.mean(face.positions, at)), f}, s.texel});
                });
            });
        }
    });
    MapStrands result;
    for (std::uint32_t f = 0; f < mesh.faces(); ++f) result.roots.area += length(face_vector(mesh, f)) / 2;
    for (const std::vector<Grown>& block : blocks)
        for (const Grown& g : block) {
            result.roots.roots.push_back(g.root);
            result.strands.push_back(g.texel);
        }
    return result;
}

}  // namespace relievo
