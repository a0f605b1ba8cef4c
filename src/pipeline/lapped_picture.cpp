#include "pipeline/lapped_picture.h"

#include "assets/image_file.h"
#include "assets/mesh_file.h"
#include "core/error.h"
#include "fur/carried_values.h"
#include "fur/comb.h"
#include "fur/facing.h"
#include "fur/refined.h"
#include "mesh/indexing.h"
#include "mesh/normals.h"
#include "mesh/simplify.h"
#include "pipeline/classic_picture.h"
#include "pipeline/fur_reference.h"
#include "pipeline/fur_space.h"
#include "pipeline/grown_fur.h"
#include "pipeline/timer.h"

#include <algorithm>
#include <cmath>
#include <future>
#include <memory>

namespace relievo {

LayersModel LappedDress::model(const LappedFurSettings& s) const {
    return {.mesh = &patches.mesh, .fur = &fur, .colour = &colour, .comb = &patches.comb, .tilt = s.coat.tilt, .bend = s.coat.bend, .height = s.coat.length, .light = s.light, .skin = s.coat.root_colour};
}

PaintedSkin lapped_skin(Mesh mesh, const CombPaint& comb, int threads) {
    mesh = in_fur_space(std::move(mesh), threads);
    mesh.normals = continuous_normals(mesh, NormalMode::angle, threads);
    const std::vector<PaintedLean> painted = painted_on(mesh, comb, threads);
    if (!painted.empty()) mesh = carrying(mesh, {}, painted);
    else mesh.uvs.clear(), mesh.colours.clear();
    PaintedSkin skin{.mesh = indexed(std::move(mesh), threads), .painted = {}};
    skin.painted = taken_off(skin.mesh, false, !painted.empty()).painted;
    return skin;
}

LappedDress lapped_dress(const Mesh& bare, const LappedFurSettings& s, std::span<const PaintedLean> painted) {
    LappedDress dress;
    const Mesh carrier = painted.empty() ? Mesh{} : carrying(bare, {}, painted);
    const Mesh& mesh = painted.empty() ? bare : carrier;
    double area = 0;
    for (std::uint32_t f = 0; f < mesh.faces(); ++f) area += length(face_vector(mesh, f)) / 2;
    if (!(area > 0)) throw Error("grow fur on", mesh.name, "it has no area");
    // A texel is as large as the number of strands asks for, a patch as all its texels; but no larger than the mesh, where strands are few.
    const double texel = std::sqrt(s.density * area / static_cast<double>(s.coat.strands));
    dress.radius = std::min(texel * s.texels / 2, 0.7);
    // Faces whose edges are a third of the radius, on the average.
    const double enough = area / (0.43 * dress.radius * dress.radius / 9);
    // Six times that many are plenty: finer scans only cost time, in growing patches and in drawing them.
    const auto most = static_cast<std::size_t>(std::clamp(6 * enough, 2000.0, 4e6));
    if (mesh.faces() > most) {
        dress.base = simplified(mesh, {.faces = most, .error = static_cast<double>(s.coat.length) / 10}, s.threads).mesh;
        dress.base.normals = continuous_normals(dress.base, NormalMode::angle, s.threads);
    } else {
        dress.base = refined(mesh, static_cast<std::size_t>(std::clamp(4 * enough, 1.0, 4e6)));
    }
    const SkinPaint values = taken_off(dress.base, false, !painted.empty());
    dress.patches = lapped(dress.base, combed(dress.base, mean_lean(s.coat), s.threads, values.painted), {.radius = dress.radius, .seed = s.seed});
    dress.texture = patch_texture(s.texels, s.density, s.seed);
    dress.fur = direction_map(MapShape::sphere, {dress.texture}, false);
    Image8 tint(1, 1, 4, 255);
    const Vec3f c = s.coat.tip_colour;
    const std::uint8_t rgb[] = {srgb_from_linear(c.x), srgb_from_linear(c.y), srgb_from_linear(c.z)};
    std::copy_n(rgb, 3, tint.texels.begin());
    dress.colour = direction_map(MapShape::sphere, {std::move(tint)}, true);
    return dress;
}

FurPicture lapped_picture(const std::filesystem::path& file, const LappedFurSettings& s, const Progress& progress) {
    FurPicture result;
    result.mode = FurKind::lapped;
    auto starting = std::async(std::launch::async, [&] { return std::make_unique<LayersRenderer>(s.device); });
    report(progress, "loading " + file.filename().string(), 0);
    const Timer loading;
    Mesh mesh = load_mesh(file, s.threads);
    result.ms.load = loading.ms();
    const std::unique_ptr<LayersRenderer> renderer = starting.get();
    result.device = renderer->device_name();
    const Timer timer;
    report(progress, "growing fur", 0.2);
    const Growth growth = with_pictures({.lengths = {}, .comb = s.comb});
    const Mesh as_painted = growth.comb.empty() ? Mesh{} : mesh;
    auto [skin, painted] = lapped_skin(std::move(mesh), growth.comb, s.threads);
    mesh = std::move(skin);
    result.ms.prepare = timer.ms();
    const Timer growing;
    const LappedDress dress = lapped_dress(mesh, s, painted);
    result.ms.roots = growing.ms();
    renderer->load(dress.model(s));
    const FurView view{.camera = view_of_sphere({0, 0, 0}, 1 + static_cast<double>(s.coat.length) * 0.6, s.width, s.height), .layers = s.layers, .passes = 1};
    FurView averaged = view;
    averaged.passes = s.passes;
    report(progress, "drawing", 0.5);
    FurFrames frames = renderer->draw(view);
    result.picture = shown_fur(frames);
    result.ms.first_frame = timer.ms();
    if (s.passes > 1) {
        frames = renderer->draw(averaged);
        result.picture = shown_fur(frames);
    }
    result.faces = mesh.faces();
    result.layer_faces = dress.patches.mesh.faces();
    result.layers = s.layers;
    result.passes = s.passes;
    result.light = s.light;
    result.notes = mesh.notes;
    const MapStrands grown = lapped_strands(dress.patches, dress.base, dress.texture);
    result.strands = grown.roots.roots.size();
    if (s.reference_samples > 0) {
        const Timer tracing;
        GrownFur even = grown_fur(painted.empty() ? mesh : as_painted, s.coat, {.lengths = {}, .comb = painted.empty() ? CombPaint{} : growth.comb}, s.threads);
        const FurFrames reference = trace_fur(curves_of(even, s.coat, reference_pieces, {}, s.threads), even.mesh, s.coat, view, s.reference_samples, s.threads, progress);
        if (s.fit_light) {
            result.light = fitted_light(*renderer, averaged, reference, s.light);
            frames = renderer->draw(averaged);
            result.picture = shown_fur(frames);
        }
        result.score = fur_score(frames, reference, s.threads);
        result.score->reference_ms = tracing.ms();
        result.score->samples = s.reference_samples;
        result.beside = side_by_side(result.picture, shown_fur(reference));
    }
    std::ranges::sort(frames.frame_ms);
    result.ms.frame_median = frames.frame_ms[frames.frame_ms.size() / 2];
    if (s.measure) {
        report(progress, "measuring", 0.9);
        result.evenness = evenness(dress.base, grown.roots, grown.strands, {.extent = 1, .threads = s.threads});
    }
    result.frames = std::move(frames);
    report(progress, "drawing", 1);
    return result;
}

}  // namespace relievo
