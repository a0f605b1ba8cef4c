#include "fur/rooted_strands.h"

#include "core/parallel_for.h"
#include "fur/strand_grid.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace relievo {

namespace {

std::uint32_t octahedral(Vec3f n) {
    const float sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    float x = n.x / sum, y = n.y / sum;
    if (n.z < 0) {
        const float fx = (1 - std::abs(y)) * (x < 0 ? -1.0f : 1.0f), fy = (1 - std::abs(x)) * (y < 0 ? -1.0f : 1.0f);
        x = fx;
        y = fy;
    }
    const auto sixteen = [](float v) { return static_cast<std::uint32_t>(static_cast<int>(std::clamp(v, -1.0f, 1.0f) * 32767 + 32767.5f) - 32767) & 0xffffu; };
    return sixteen(x) | sixteen(y) << 16;
}

std::uint32_t three_tens(Vec3f v) {
    const auto ten = [](float c) { return static_cast<std::uint32_t>(std::clamp(c * 0.5f + 0.5f, 0.0f, 1.0f) * 1023 + 0.5f); };
    return ten(v.x) | ten(v.y) << 10 | ten(v.z) << 20;
}

// Ten bits, two zeros after each.
std::uint32_t spread_bits(std::uint32_t v) {
    v = (v | v << 16) & 0x030000ffu;
    v = (v | v << 8) & 0x0300f00fu;
    v = (v | v << 4) & 0x030c30c3u;
    return (v | v << 2) & 0x09249249u;
}

// The numbers of the roots along Morton's curve through 1024 cells a side (Morton 1966), by three passes over ten bits each.
std::vector<std::uint32_t> curve_order(const Roots& roots, int threads) {
    const std::size_t count = roots.roots.size();
    Vec3f low = roots.roots[0].position, high = low;
    for (const Root& r : roots.roots) {
        low = {std::min(low.x, r.position.x), std::min(low.y, r.position.y), std::min(low.z, r.position.z)};
        high = {std::max(high.x, r.position.x), std::max(high.y, r.position.y), std::max(high.z, r.position.z)};
    }
    const float scale = 1023.99f / std::max({high.x - low.x, high.y - low.y, high.z - low.z, 1e-30f});
    struct Placed {
        std::uint32_t code, number;
    };
    std::vector<Placed> from(count), to(count);
    parallel_for(static_cast<int>(count), 16384, threads, [&](int begin, int end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
            const Vec3f p = (roots.roots[i].position - low) * scale;
            from[i] = {spread_bits(static_cast<std::uint32_t>(p.x)) | spread_bits(static_cast<std::uint32_t>(p.y)) << 1 | spread_bits(static_cast<std::uint32_t>(p.z)) << 2,
                       static_cast<std::uint32_t>(i)};
        }
    });
    std::array<std::array<std::uint32_t, 1025>, 3> first{};
    for (const Placed& p : from)
        for (std::uint32_t d = 0; d < 3; ++d) ++first[d][(p.code >> (10 * d) & 1023u) + 1];
    for (std::uint32_t d = 0; d < 3; ++d) {
        for (std::size_t k = 0; k < 1024; ++k) first[d][k + 1] += first[d][k];
        for (const Placed& p : from) to[first[d][p.code >> (10 * d) & 1023u]++] = p;
        std::swap(from, to);
    }
    std::vector<std::uint32_t> order(count);
    for (std::size_t i = 0; i < count; ++i) order[i] = from[i].number;
    return order;
}

}  // namespace

RootedStrands rooted_strands(const Mesh& mesh, const std::vector<Vec3f>& comb, const std::vector<float>& lengths, const Roots& roots, int threads) {
    assert(mesh.normals.size() == mesh.positions.size() && comb.size() == mesh.positions.size() && (lengths.empty() || lengths.size() == mesh.positions.size()));
    RootedStrands strands;
    if (roots.roots.empty()) return strands;
    strands.places.resize(roots.roots.size());
    strands.natures.resize(roots.roots.size());
    strands.roots = curve_order(roots, threads);
    parallel_for(static_cast<int>(strands.places.size()), 4096, threads, [&](int begin, int end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
            const Root& root = roots.roots[strands.roots[i]];
            const Vec3f w = corner_weights(mesh, root);
            const std::uint32_t* v = &mesh.indices[std::size_t{root.face} * 3];
            const auto mean = [&](const auto& of) { return of[v[0]] * w.x + of[v[1]] * w.y + of[v[2]] * w.z; };
            const Vec3f n = mean(mesh.normals);
            const float l = length(n), share = lengths.empty() ? 1.0f : mean(lengths);
            strands.places[i] = {.root = root.position, .comb = three_tens(mean(comb))};
            strands.natures[i] = {.normal = octahedral(l > 0 ? n / l : Vec3f(0, 1, 0)),
                                  .own = strand_chance(root.position) | static_cast<std::uint32_t>(std::clamp(share, 0.0f, 1.0f) * 65535 + 0.5f) << 16};
        }
    });
    return strands;
}

std::vector<std::array<float, 4>> at_strands(const RootedStrands& strands, const Mesh& mesh, const Roots& roots, std::span<const Vec3f> of_vertices, int threads) {
    assert(of_vertices.size() == mesh.positions.size());
    std::vector<std::array<float, 4>> values(strands.roots.size());
    parallel_for(static_cast<int>(values.size()), 4096, threads, [&](int begin, int end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
            const Root& root = roots.roots[strands.roots[i]];
            const Vec3f w = corner_weights(mesh, root);
            const std::uint32_t* v = &mesh.indices[std::size_t{root.face} * 3];
            const Vec3f p = of_vertices[v[0]] * w.x + of_vertices[v[1]] * w.y + of_vertices[v[2]] * w.z;
            values[i] = {p.x, p.y, p.z, 0};
        }
    });
    return values;
}

}  // namespace relievo
