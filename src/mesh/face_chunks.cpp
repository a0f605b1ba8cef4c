#include "mesh/face_chunks.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <span>

namespace relievo {

namespace {

constexpr std::size_t bins = 256;        // along each axis; a cut is made between two of them
constexpr double smallest_share = 0.45;  // of the faces on the smaller side: threads should end together

struct Plane {
    std::size_t axis = 0;
    float low = 0, scale = 0;  // bin = (coordinate - low) * scale
    std::size_t cut = 0;       // first bin of the upper half
};

float coordinate(const Vec3f& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

std::size_t bin_of(float v, float low, float scale) { return std::min(static_cast<std::size_t>((v - low) * scale), bins - 1); }

// The plane that the fewest faces come near to, among those that halve well; `cut` 0 where none does.
Plane thinnest_cut(const Mesh& mesh, std::span<const std::uint32_t> faces) {
    const auto corner = [&](std::uint32_t f) -> const Vec3f& { return mesh.positions[mesh.indices[f * std::size_t{3}]]; };
    Vec3f low = corner(faces[0]), high = low;
    for (const std::uint32_t f : faces) {
        const Vec3f& p = corner(f);
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    std::array<Plane, 3> planes;
    std::array<std::array<std::uint32_t, bins>, 3> held{};
    for (std::size_t a = 0; a < 3; ++a) {
        const float size = coordinate(high, a) - coordinate(low, a);
        planes[a] = {a, coordinate(low, a), size > 0 ? static_cast<float>(bins) / size : 0.0f, 0};
    }
    for (const std::uint32_t f : faces)
        for (std::size_t a = 0; a < 3; ++a) ++held[a][bin_of(coordinate(corner(f), a), planes[a].low, planes[a].scale)];

    Plane best;
    double least = -1;
    for (Plane plane : planes) {
        double below = 0;
        for (std::size_t b = 1; b < bins; ++b) {
            below += held[plane.axis][b - 1];
            const double share = below / static_cast<double>(faces.size());
            if (share < smallest_share || share > 1 - smallest_share) continue;
            // Faces near the plane per length along the axis: as many as its cut through the surface is long.
            const double near = (held[plane.axis][b - 1] + held[plane.axis][b]) * static_cast<double>(plane.scale);
            if (least >= 0 && near >= least) continue;
            least = near;
            plane.cut = b;
            best = plane;
        }
    }
    return best;
}

}  // namespace

FaceChunks face_chunks(const Mesh& mesh, std::uint32_t least_faces, int threads) {
    const auto count = static_cast<std::uint32_t>(mesh.faces());
    FaceChunks chunks;
    chunks.faces.resize(count);
    std::iota(chunks.faces.begin(), chunks.faces.end(), 0u);
    chunks.begin = {0, count};
    std::vector<std::uint32_t> other;
    while (count / (chunks.count() * 2) >= least_faces) {
        other.resize(count);
        std::vector<std::uint32_t> begin(chunks.count() * 2 + 1, count);
        parallel_for(static_cast<int>(chunks.count()), 1, threads, [&](int first, int last) {
            for (auto c = static_cast<std::size_t>(first); c < static_cast<std::size_t>(last); ++c) {
                const std::uint32_t from = chunks.begin[c], to = chunks.begin[c + 1];
                const std::span<const std::uint32_t> faces = std::span(chunks.faces).subspan(from, to - from);
                const Plane plane = thinnest_cut(mesh, faces);
                const auto upper = [&](std::uint32_t f) {
                    return bin_of(coordinate(mesh.positions[mesh.indices[f * std::size_t{3}]], plane.axis), plane.low, plane.scale) >= plane.cut;
                };
                // No plane halves what lies in a heap: then the order of the faces does.
                const auto middle = plane.cut > 0
                                        ? from + static_cast<std::uint32_t>(std::ranges::count_if(faces, [&](std::uint32_t f) { return !upper(f); }))
                                        : from + (to - from) / 2;
                begin[2 * c] = from;
                begin[2 * c + 1] = middle;
                if (plane.cut == 0) {
                    std::ranges::copy(faces, other.begin() + from);
                    continue;
                }
                std::uint32_t lower_place = from, upper_place = middle;
                for (const std::uint32_t f : faces) other[upper(f) ? upper_place++ : lower_place++] = f;
            }
        });
        chunks.faces.swap(other);
        chunks.begin = std::move(begin);
    }
    return chunks;
}

}  // namespace relievo
