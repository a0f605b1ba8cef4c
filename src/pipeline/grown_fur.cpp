#include "pipeline/grown_fur.h"

#include "core/error.h"
#include "fur/comb.h"
#include "mesh/normals.h"
#include "mesh/repair.h"
#include "pipeline/fur_space.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace relievo {

GrownFur grown_fur(Mesh mesh, const Coat& coat, int threads) {
    GrownFur fur;
    FurSpace space = moved_into_fur_space(std::move(mesh), threads);
    fur.mesh = std::move(space.mesh);
    fur.mesh.normals.clear();  // those of files need not be continuous
    fur.sphere = space.sphere;
    const auto start = std::chrono::steady_clock::now();
    const RootSettings wanted{.count = static_cast<std::uint32_t>(coat.strands), .threads = threads};
    fur.roots = grow_roots(fur.mesh, wanted);
    if (static_cast<double>(fur.roots.roots.size()) < 0.8 * wanted.count && wanted.count > 500) {
        // Faces lie on one another and had the area counted twice.
        const std::string name = fur.mesh.name;
        fur.mesh = repaired(std::move(fur.mesh), threads).mesh;
        if (fur.mesh.faces() == 0) throw Error("grow fur on", name, "all its faces are collapsed or repeated", "scan or save it again: there is no surface to grow on");
        fur.roots = grow_roots(fur.mesh, wanted);
    }
    fur.spacing = static_cast<float>(std::sqrt(fur.roots.area / static_cast<double>(std::max<std::size_t>(fur.roots.roots.size(), 1))));
    fur.roots_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return fur;
}

StrandCurves curves_of(GrownFur& fur, const Coat& coat, int pieces, int threads) {
    if (fur.mesh.normals.empty()) fur.mesh.normals = continuous_normals(fur.mesh, NormalMode::angle, threads);
    return strand_curves(fur.mesh, combed(fur.mesh, mean_lean(coat), threads), fur.roots, coat, fur.spacing, pieces, threads);
}

}  // namespace relievo
