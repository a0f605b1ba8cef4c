#include "mesh/simplify.h"

#include "mesh/equal_vertices.h"
#include "mesh/indexing.h"

#include <algorithm>
#include <cassert>
#include <meshoptimizer.h>

namespace relievo {

namespace {

// Within this share of the wanted count it is reached.
constexpr double near_enough = 0.01;

// Faces for each one wanted that clusters leave to the collapse of edges, which then still has a choice.
constexpr std::size_t left_by_clusters = 5;

std::vector<std::uint32_t> collapse(const std::vector<Vec3f>& positions, const std::vector<std::uint32_t>& indices, const SimplifyTarget& target,
                                    double& error) {
    std::vector<std::uint32_t> coarse(indices.size());
    float reached = 0;
    // Without a limit of its own any deviation up to the whole extent is allowed.
    const float limit = target.error > 0 ? static_cast<float>(target.error) : 1.0f;
    coarse.resize(meshopt_simplify(coarse.data(), indices.data(), indices.size(), &positions[0].x, positions.size(), sizeof(Vec3f),
                                   target.faces * 3, limit, 0, &reached));
    error = reached;
    return coarse;
}

// One of the vertices in each cell of a grid, whose width is chosen by the count, stands for the others.
std::vector<std::uint32_t> clustered(const Mesh& mesh, std::size_t faces, double& error) {
    std::vector<std::uint32_t> coarse(mesh.indices.size());
    float reached = 0;
    coarse.resize(meshopt_simplifySloppy(coarse.data(), mesh.indices.data(), mesh.indices.size(), &mesh.positions[0].x, mesh.positions.size(), sizeof(Vec3f),
                                         faces * 3, 1.0f, &reached));
    error = reached;
    return coarse;
}

// The same with one vertex per position, which meshoptimizer must not see the others beside: it would keep them for seams.
std::vector<std::uint32_t> collapse_without_seams(const Mesh& mesh, const std::vector<std::uint32_t>& indices, const SimplifyTarget& target,
                                                  double& error, int threads) {
    const std::vector<std::uint32_t> first = first_equal_vertex(mesh, Compared::positions, threads);
    std::vector<std::uint32_t> number(first.size(), 0), vertex;
    std::vector<Vec3f> positions;
    std::vector<std::uint32_t> joined;
    joined.reserve(indices.size());
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::uint32_t face[3] = {first[indices[i]], first[indices[i + 1]], first[indices[i + 2]]};
        if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0]) continue;
        for (const std::uint32_t v : face) {
            if (number[v] == 0) {
                vertex.push_back(v);
                positions.push_back(mesh.positions[v]);
                number[v] = static_cast<std::uint32_t>(vertex.size());
            }
            joined.push_back(number[v] - 1);
        }
    }
    if (joined.empty()) return indices;
    std::vector<std::uint32_t> coarse = collapse(positions, joined, target, error);
    for (std::uint32_t& v : coarse) v = vertex[v];
    return coarse;
}

}  // namespace

SimplifiedMesh simplified(const Mesh& mesh, const SimplifyTarget& target, int threads) {
    assert(target.faces > 0 || target.error > 0);
    SimplifiedMesh result;
    result.mesh = mesh;
    if (mesh.indices.empty() || (target.faces >= mesh.faces())) return result;
    double error = 0, before = 0;
    const bool cluster = target.fast && target.faces > 0 && mesh.faces() > 2 * left_by_clusters * target.faces;
    std::vector<std::uint32_t> coarse = collapse(mesh.positions, cluster ? clustered(mesh, left_by_clusters * target.faces, before) : mesh.indices, target, error);
    error += before;
    if (target.faces > 0 && static_cast<double>(coarse.size()) > static_cast<double>(target.faces * 3) * (1 + near_enough)) {
        double more = 0;
        std::vector<std::uint32_t> coarser = collapse_without_seams(mesh, coarse, target, more, threads);
        if (coarser.size() < coarse.size()) {
            coarse = std::move(coarser);
            error = std::max(error, more);
            if (!mesh.uvs.empty()) result.mesh.notes.emplace_back("simplify: seams of the texture coordinates were closed to reach the count");
        }
    }
    result.estimated_error = error * static_cast<double>(meshopt_simplifyScale(&mesh.positions[0].x, mesh.positions.size(), sizeof(Vec3f)));
    result.mesh.indices = std::move(coarse);
    result.mesh = indexed(std::move(result.mesh), threads);
    return result;
}

}  // namespace relievo
