#include "pipeline/fur_space.h"

#include "core/error.h"
#include "core/parallel_for.h"
#include "mesh/indexing.h"

#include <algorithm>

namespace relievo {

FurSpace moved_into_fur_space(Mesh mesh, int threads) {
    if (mesh.faces() == 0) throw Error("grow fur on", mesh.name, "it has no faces");
    std::vector<std::uint8_t> used(mesh.positions.size(), 0);
    for (const std::uint32_t v : mesh.indices) used[v] = 1;
    if (std::ranges::find(used, 0) != used.end()) mesh = indexed(std::move(mesh), threads);
    const Sphere sphere = bounding_sphere(mesh.positions, threads);
    if (!(sphere.radius > 0)) throw Error("grow fur on", mesh.name, "all its points are one", "scan or save it again: it has no size");
    // In double, as scans may lie far from their origin.
    const double scale = 1 / sphere.radius;
    parallel_for(static_cast<int>(mesh.positions.size()), 65536, threads, [&](int begin, int end) {
        for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) mesh.positions[v] = Vec3f((Vec3d(mesh.positions[v]) - sphere.centre) * scale);
    });
    return {std::move(mesh), sphere};
}

Mesh in_fur_space(Mesh mesh, int threads) { return moved_into_fur_space(std::move(mesh), threads).mesh; }

}  // namespace relievo
