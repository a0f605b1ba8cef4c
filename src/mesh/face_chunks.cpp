#include "mesh/face_chunks.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>

namespace relievo {

namespace {

constexpr std::size_t bins = 1024;       // along each axis; a cut is made between two of them
constexpr double smallest_share = 0.45;  // of the faces on the smaller side: threads should end together
constexpr std::uint32_t block = 65536;   // faces that a thread looks at in a row
constexpr std::size_t around_cut = 2;    // bins on each side whose faces count as near a plane: one alone is noise

// Smaller meshes are at hand in a core's own memory in whatever order their faces are.
constexpr std::uint32_t sorted_from = 50000;

// A face and the bins of its first corner, ten bits an axis.
struct Item {
    std::uint32_t face = 0, key = 0;
    std::size_t bin(std::size_t axis) const { return key >> (10 * axis) & (bins - 1); }
};

using Held = std::array<std::array<std::uint32_t, bins>, 3>;  // faces per bin of each axis

struct Plane {
    std::size_t axis = 0;
    std::size_t cut = 0;  // first bin of the upper half; 0: no plane
};

// A part of a chunk.
struct Block {
    std::size_t chunk;
    std::uint32_t begin, end;
    std::uint32_t lower, upper;  // where its faces go
    Held held;
};

float coordinate(const Vec3f& v, std::size_t axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

Vec3f lower(Vec3f a, Vec3f b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3f upper(Vec3f a, Vec3f b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

struct Box {
    Vec3f low{std::numeric_limits<float>::max()}, high{std::numeric_limits<float>::lowest()};
};

Box box_of(const std::vector<Vec3f>& positions, int threads) {
    std::vector<Box> boxes((positions.size() + block - 1) / block);
    parallel_for(static_cast<int>(positions.size()), block, threads, [&](int begin, int end) {
        Box& box = boxes[static_cast<std::size_t>(begin) / block];
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
            box.low = lower(box.low, positions[i]);
            box.high = upper(box.high, positions[i]);
        }
    });
    Box all;
    for (const Box& box : boxes) all = {lower(all.low, box.low), upper(all.high, box.high)};
    return all;
}

std::vector<Item> items_of(const Mesh& mesh, const Box& box, int threads) {
    std::vector<Item> items(mesh.faces());
    std::array<float, 3> low{}, scale{};
    for (std::size_t a = 0; a < 3; ++a) {
        low[a] = coordinate(box.low, a);
        const float size = coordinate(box.high, a) - low[a];
        scale[a] = size > 0 ? static_cast<float>(bins) / size : 0.0f;
    }
    parallel_for(static_cast<int>(items.size()), block, threads, [&](int begin, int end) {
        for (auto f = static_cast<std::uint32_t>(begin); f < static_cast<std::uint32_t>(end); ++f) {
            const Vec3f& corner = mesh.positions[mesh.indices[f * std::size_t{3}]];
            std::uint32_t key = 0;
            for (std::size_t a = 0; a < 3; ++a) {
                // Sizes near the limits of float would overflow the product; what is left of it stays within the bins.
                const float place = (coordinate(corner, a) - low[a]) * scale[a];
                key |= (place < static_cast<float>(bins - 1) ? static_cast<std::uint32_t>(place) : static_cast<std::uint32_t>(bins - 1)) << (10 * a);
            }
            items[f] = {f, key};
        }
    });
    return items;
}

// The plane that the fewest faces come near to, among those that halve well.
Plane thinnest_cut(const Held& held, std::uint32_t faces, const Box& box) {
    Plane best;
    double least = -1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double size = static_cast<double>(coordinate(box.high, axis)) - static_cast<double>(coordinate(box.low, axis));
        double below = 0;
        for (std::size_t b = 1; b < bins; ++b) {
            below += held[axis][b - 1];
            const double share = below / faces;
            if (share < smallest_share || share > 1 - smallest_share) continue;
            // Faces near the plane per length along the axis: as many as its cut through the surface is long.
            double near = 0;
            for (std::size_t i = b - std::min(b, around_cut); i < std::min(b + around_cut, bins); ++i) near += held[axis][i];
            near /= size;
            if (least >= 0 && near >= least) continue;
            least = near;
            best = {axis, b};
        }
    }
    return best;
}

// Morton's curve through the cells of a grid: the highest five bits of the three bins in turn.
constexpr std::size_t curve_cells = 1 << 15;
std::uint32_t cell_on_curve(const Item& item) {
    static constexpr std::array<std::uint16_t, 32> spread = [] {
        std::array<std::uint16_t, 32> s{};
        for (std::uint32_t i = 0; i < 32; ++i)
            for (std::uint32_t bit = 0; bit < 5; ++bit) s[i] = static_cast<std::uint16_t>(s[i] | (i >> bit & 1) << (3 * bit));
        return s;
    }();
    return static_cast<std::uint32_t>(spread[item.bin(0) >> 5] | spread[item.bin(1) >> 5] << 1 | spread[item.bin(2) >> 5] << 2);
}

// The faces cell by cell, those of one cell in their own order: `items` as they stand are in the order of the mesh.
void along_curve(std::span<const Item> items, std::uint32_t* faces) {
    std::vector<std::uint32_t> next(curve_cells + 1, 0);
    for (const Item& item : items) ++next[cell_on_curve(item) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (const Item& item : items) faces[next[cell_on_curve(item)]++] = item.face;
}

std::vector<Block> blocks_of(const std::vector<std::uint32_t>& begin) {
    std::vector<Block> blocks;
    for (std::size_t c = 0; c + 1 < begin.size(); ++c)
        for (std::uint32_t from = begin[c]; from < begin[c + 1]; from += std::min(block, begin[c + 1] - from))
            blocks.push_back({c, from, from + std::min(block, begin[c + 1] - from), 0, 0, {}});
    return blocks;
}

}  // namespace

FaceChunks face_chunks(const Mesh& mesh, std::uint32_t least_faces, int threads) {
    const auto count = static_cast<std::uint32_t>(mesh.faces());
    FaceChunks chunks;
    chunks.faces.resize(count);
    chunks.begin = {0, count};
    if (count < sorted_from && count / 2 < least_faces) {
        std::iota(chunks.faces.begin(), chunks.faces.end(), 0u);
        return chunks;
    }
    const Box box = box_of(mesh.positions, threads);
    std::vector<Item> items = items_of(mesh, box, threads), other(count);
    while (count / (chunks.count() * 2) >= least_faces) {
        std::vector<Block> blocks = blocks_of(chunks.begin);
        const auto for_blocks = [&](const auto& body) {
            parallel_for(static_cast<int>(blocks.size()), 1, threads, [&](int first, int last) {
                for (auto b = static_cast<std::size_t>(first); b < static_cast<std::size_t>(last); ++b) body(blocks[b]);
            });
        };
        for_blocks([&](Block& b) {
            for (std::uint32_t i = b.begin; i < b.end; ++i)
                for (std::size_t a = 0; a < 3; ++a) ++b.held[a][items[i].bin(a)];
        });
        std::vector<Held> held(chunks.count());
        for (const Block& b : blocks)
            for (std::size_t a = 0; a < 3; ++a)
                for (std::size_t i = 0; i < bins; ++i) held[b.chunk][a][i] += b.held[a][i];
        std::vector<Plane> planes(chunks.count());
        std::vector<std::uint32_t> begin(chunks.count() * 2 + 1, count);
        for (std::size_t c = 0; c < chunks.count(); ++c) {
            const std::uint32_t from = chunks.begin[c], faces = chunks.begin[c + 1] - from;
            planes[c] = thinnest_cut(held[c], faces, box);
            begin[2 * c] = from;
            // No plane halves what lies in a heap: then the order of the faces does.
            begin[2 * c + 1] = from + (planes[c].cut > 0 ? std::accumulate(held[c][planes[c].axis].begin(), held[c][planes[c].axis].begin() + static_cast<std::ptrdiff_t>(planes[c].cut), 0u)
                                                         : faces / 2);
        }
        std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
        for (Block& b : blocks) {
            const Plane& plane = planes[b.chunk];
            const auto& counts = b.held[plane.axis];
            b.lower = next[2 * b.chunk];
            b.upper = next[2 * b.chunk + 1];
            const std::uint32_t below = std::accumulate(counts.begin(), counts.begin() + static_cast<std::ptrdiff_t>(plane.cut), 0u);
            next[2 * b.chunk] += below;
            next[2 * b.chunk + 1] += b.end - b.begin - below;
        }
        for_blocks([&](Block& b) {
            const Plane plane = planes[b.chunk];
            if (plane.cut == 0) {
                std::copy(items.begin() + b.begin, items.begin() + b.end, other.begin() + b.begin);
                return;
            }
            for (std::uint32_t i = b.begin; i < b.end; ++i) other[items[i].bin(plane.axis) < plane.cut ? b.lower++ : b.upper++] = items[i];
        });
        items.swap(other);
        chunks.begin = std::move(begin);
    }
    other = {};
    parallel_for(static_cast<int>(chunks.count()), 1, threads, [&](int first, int last) {
        for (auto c = static_cast<std::size_t>(first); c < static_cast<std::size_t>(last); ++c)
            along_curve(std::span(items).subspan(chunks.begin[c], chunks.begin[c + 1] - chunks.begin[c]), &chunks.faces[chunks.begin[c]]);
    });
    return chunks;
}

}  // namespace relievo
