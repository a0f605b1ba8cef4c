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

}  // namespace

RootedStrands rooted_strands(const Mesh& mesh, const std::vector<Vec3f>& comb, const std::vector<float>& lengths, const Roots& roots, int threads) {
    assert(mesh.normals.size() == mesh.positions.size() && comb.size() == mesh.positions.size() && (lengths.empty() || lengths.size() == mesh.positions.size()));
    RootedStrands strands;
    if (roots.roots.empty()) return strands;
    strands.places.resize(roots.roots.size());
    strands.natures.resize(roots.roots.size());
    parallel_for(static_cast<int>(strands.places.size()), 4096, threads, [&](int begin, int end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
            const Root& root = roots.roots[i];
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

std::vector<std::array<float, 4>> at_strands(const Mesh& mesh, const Roots& roots, std::span<const Vec3f> of_vertices, int threads) {
    assert(of_vertices.size() == mesh.positions.size());
    std::vector<std::array<float, 4>> values(roots.roots.size());
    parallel_for(static_cast<int>(values.size()), 4096, threads, [&](int begin, int end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
            const Root& root = roots.roots[i];
            const Vec3f w = corner_weights(mesh, root);
            const std::uint32_t* v = &mesh.indices[std::size_t{root.face} * 3];
            const Vec3f p = of_vertices[v[0]] * w.x + of_vertices[v[1]] * w.y + of_vertices[v[2]] * w.z;
            values[i] = {p.x, p.y, p.z, 0};
        }
    });
    return values;
}

}  // namespace relievo
