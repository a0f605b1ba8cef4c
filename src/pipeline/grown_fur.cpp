#include "pipeline/grown_fur.h"

#include "assets/image_file.h"
#include "core/error.h"
#include "fur/comb.h"
#include "mesh/normals.h"
#include "mesh/repair.h"
#include "pipeline/fur_space.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

namespace relievo {

Growth with_pictures(Growth growth) {
    for (LengthRule& r : growth.lengths)
        if (!r.file.empty()) r.mask = std::make_shared<const ImageF>(read_image(r.file, FirstRow::bottom));
    if (!growth.comb.file.empty()) growth.comb.picture = std::make_shared<const ImageF>(read_image(growth.comb.file, FirstRow::bottom));
    return growth;
}

std::vector<PaintedLean> painted_on(Mesh& mesh, const CombPaint& comb, int threads) {
    if (comb.empty()) return {};
    if (mesh.normals.empty()) mesh.normals = continuous_normals(mesh, NormalMode::angle, threads);
    std::vector<PaintedLean> painted = painted_leans(mesh, comb);
    if (painted.empty()) mesh.notes.emplace_back("The painted comb has no weight anywhere on the mesh: the fur lies as it would without.");
    return painted;
}

GrownFur grown_fur(Mesh mesh, const Coat& coat, const Growth& growth, int threads) {
    const std::vector<LengthRule>& rules = growth.lengths;
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
    if (!rules.empty()) {
        fur.mesh.normals = continuous_normals(fur.mesh, NormalMode::angle, threads);
        fur.lengths = length_shares(fur.mesh, fur.sphere, rules, threads);
        if (fur.mesh.uvs.empty() && std::ranges::find(rules, LengthQuantity::mask, &LengthRule::quantity) != rules.end())
            fur.mesh.notes.emplace_back("The mesh has no texture coordinates: the mask was thrown on along z, over its box of x and y.");
        const std::size_t all = fur.roots.roots.size();
        std::erase_if(fur.roots.roots, [&](const Root& root) {
            const Vec3f w = corner_weights(fur.mesh, root);
            const std::uint32_t* v = &fur.mesh.indices[std::size_t{root.face} * 3];
            return fur.lengths[v[0]] * w.x + fur.lengths[v[1]] * w.y + fur.lengths[v[2]] * w.z < shortest_share;
        });
        fur.bare = all - fur.roots.roots.size();
        if (fur.roots.roots.empty()) throw Error("grow fur on", fur.mesh.name, "the rules leave all of it bare", "turn one round (FROM..TO) or leave it out");
    }
    fur.upright = growth.upright;
    fur.painted = painted_on(fur.mesh, growth.comb, threads);
    fur.spacing = static_cast<float>(std::sqrt(fur.roots.area / static_cast<double>(std::max<std::size_t>(fur.roots.roots.size() + fur.bare, 1))));
    fur.roots_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return fur;
}

std::vector<Vec3f> comb_of(GrownFur& fur, const Coat& coat, int threads) {
    if (fur.mesh.normals.empty()) fur.mesh.normals = continuous_normals(fur.mesh, NormalMode::angle, threads);
    return fur.upright ? upright_but_for(fur.mesh, fur.painted) : combed(fur.mesh, mean_lean(coat), threads, fur.painted);
}

StrandCurves curves_of(GrownFur& fur, const Coat& coat, int pieces, const FurForces& forces, int threads) {
    const std::vector<Vec3f> comb = comb_of(fur, coat, threads);
    std::vector<Vec3f> pushes;
    if (length(forces.gravity) > 0 || length(forces.wind) > 0) pushes = pushes_of(settled({fur.mesh, comb, fur.lengths, coat}, forces, threads));
    return strand_curves(fur.mesh, comb, fur.roots, coat, fur.spacing, pieces, threads, {.lengths = fur.lengths, .pushes = pushes});
}

}  // namespace relievo
