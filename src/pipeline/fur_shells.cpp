#include "pipeline/fur_shells.h"

#include "fur/carried_values.h"
#include "fur/comb.h"
#include "fur/shell_texture.h"
#include "fur/strand_albedo.h"
#include "mesh/chart_atlas.h"
#include "mesh/normals.h"
#include "mesh/simplify.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace relievo {

namespace {

// A strand at every vertex, without what sets single strands apart: where layers go.
StrandCurves pushed_out(const Mesh& mesh, Coat coat, const SkinPaint& values, const FurForces& forces, int layers, int threads) {
    Roots vertices;
    std::vector<std::uint32_t> face(mesh.positions.size(), 0);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) face[mesh.indices[i]] = static_cast<std::uint32_t>(i / 3);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) vertices.roots.push_back({mesh.positions[v], face[v]});
    coat.spread = coat.length_variation = coat.curl_radius = coat.guard_hairs = 0;
    const std::vector<Vec3f> comb = combed(mesh, mean_lean(coat), threads, values.painted);
    std::vector<Vec3f> pushes;
    if (length(forces.gravity) > 0 || length(forces.wind) > 0) pushes = pushes_of(settled({mesh, comb, values.lengths, coat}, forces, threads));
    return strand_curves(mesh, comb, vertices, coat, 0, 2 * layers, threads, {.lengths = values.lengths, .pushes = pushes});
}

Vec3f shade_at(const Coat& coat, double level) {
    const auto colour = [&](double way) { return strand_albedo(coat, {.normal = {0, 1, 0}, .chance = 0x8080}, way); };
    // Deep in the fur it is dark, as in the layers' own program.
    const Vec3d here = colour(level), there = colour(0.7);
    const double open = 0.35 + 0.65 * level;
    const auto one = [&](double a, double b) { return static_cast<float>(std::clamp(a / std::max(b, 1e-6) * open, 0.0, 1.0)); };
    return {one(here.x, there.x), one(here.y, there.y), one(here.z, there.z)};
}

}  // namespace

FurShells fur_shells(GrownFur& fur, const Coat& coat, const FurForces& forces, const ShellSettings& s) {
    FurShells shells;
    Mesh skin = carrying(fur.mesh, fur.lengths, fur.painted);
    if (fur.lengths.empty() && fur.painted.empty()) {
        // Only the atlas will need texture coordinates: its own.
        skin.uvs.clear();
        skin.colours.clear();
    }
    double off = 0;
    if (skin.faces() > s.faces) {
        SimplifiedMesh simpler = simplified(skin, {.faces = s.faces}, s.threads);
        skin = std::move(simpler.mesh);
        off = simpler.estimated_error;
    }
    skin.normals = continuous_normals(skin, NormalMode::angle, s.threads);
    const SkinPaint values = taken_off(skin, !fur.lengths.empty(), !fur.painted.empty());

    int size = s.atlas > 0 ? s.atlas : 2048;
    ChartAtlas atlas = chart_atlas(skin, size, s.threads);
    const double thickness = 2 * static_cast<double>(coat.width * fur.spacing);
    if (s.atlas == 0 && thickness < 2 * atlas.texel) atlas = chart_atlas(skin, size = 4096, s.threads);
    if (thickness < 2 * atlas.texel) {
        char text[192];
        std::snprintf(text, sizeof text, "Strands are %.1f texels thick: below 2 they melt into one another. Take a larger --atlas, or fewer strands (--density %.0f).", thickness / atlas.texel,
                      std::floor(100 * std::pow(thickness / (2 * atlas.texel), 2)));
        shells.notes.emplace_back(text);
    }
    // Layers two thicknesses apart hang together from most directions; 32 are what viewers draw at ease.
    const int layers = s.layers > 0 ? s.layers : std::clamp(static_cast<int>(std::ceil(static_cast<double>(coat.length) / (2 * thickness))), 12, 32);
    ShellTexture texture = shell_texture(atlas, fur.mesh, fur.roots, coat, fur.spacing, off, s.threads);
    const StrandCurves out = pushed_out(skin, coat, values, forces, layers, s.threads);

    ShellScene& scene = shells.scene;
    scene.name = fur.mesh.name;
    scene.centre = fur.sphere.centre;
    scene.radius = fur.sphere.radius;
    scene.skin = atlas.mesh.positions;
    scene.skin_normals = atlas.mesh.normals;
    scene.uvs = atlas.mesh.uvs;
    scene.indices = atlas.mesh.indices;
    scene.skin_colour = coat.root_colour * 0.35f;
    scene.texture = std::move(texture.texels);
    // glTF wants unit normals.
    for (Vec3f& n : scene.skin_normals)
        if (!(dot(n, n) > 0)) n = {0, 1, 0};
    for (int k = 0; k < layers; ++k) {
        const double level = (k + 0.5) / layers;
        ShellScene::Layer& l = scene.layers.emplace_back();
        l.cutoff = static_cast<float>(level);
        l.shade = shade_at(coat, level);
        const auto stride = static_cast<std::size_t>(2 * layers + 1);
        for (const std::uint32_t v : atlas.vertex) l.positions.push_back(out.points[v * stride + static_cast<std::size_t>(2 * k + 1)]);
        l.normals = scene.skin_normals;
    }
    shells.charts = atlas.charts;
    shells.texel = atlas.texel;
    shells.covered = texture.covered;
    return shells;
}

}  // namespace relievo
