#include "pipeline/fur_picture.h"

#include "assets/image_file.h"
#include "assets/mesh_file.h"
#include "fur/comb.h"
#include "fur/likeness.h"
#include "fur/refined.h"
#include "fur/strand_grid.h"
#include "mesh/normals.h"
#include "mesh/simplify.h"
#include "pipeline/fur_reference.h"
#include "pipeline/grown_fur.h"
#include "render/fur_renderer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>

namespace relievo {

namespace {

class Timer {
public:
    double ms() const { return std::chrono::duration<double, std::milli>(Clock::now() - start_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

// One layer for every two pixels of the fur's height in the picture: then nothing shows between them at silhouettes.
int layers_for(const MeshView& view, const Coat& coat) {
    const double distance = length(view.camera.eye - view.camera.target);
    const double turn = std::max(coat.bend, 1e-3f), rise = coat.length * (std::sin(coat.tilt + turn) - std::sin(coat.tilt)) / turn;
    const double pixels = rise / (distance * 2 * std::tan(view.camera.fov_y_rad / 2) / view.height);
    return std::clamp(static_cast<int>(std::ceil(pixels / 2)), 6, 48);
}

// Layers are drawn from a mesh of faces of some hundred pixels: smaller ones cost more than the pixels in them, and how the skin lies
// is told by roots, which grow on the mesh itself. In the picture the unit sphere covers a disc; a surface's two sides and folds cover
// about six times as much.
std::size_t layer_faces(const MeshView& view) {
    const double distance = length(view.camera.eye - view.camera.target);
    const double radius_px = 1 / (distance * 2 * std::tan(view.camera.fov_y_rad / 2) / view.height);
    constexpr double pixels_per_face = 360;
    return static_cast<std::size_t>(std::clamp(6 * 3.14 * radius_px * radius_px / pixels_per_face, 6000.0, 1e6));
}

}  // namespace

void write_fur_picture(const std::filesystem::path& png, const Image8& picture) { write_png(png, picture, FirstRow::top); }

FurPicture fur_picture(const std::filesystem::path& file, const FurSettings& settings, const Progress& progress) {
    FurPicture result;
    // The device starts while the file is read.
    auto starting = std::async(std::launch::async, [&] { return std::make_unique<FurRenderer>(settings.device); });
    report(progress, "loading " + file.filename().string(), 0);
    const Timer loading;
    Mesh mesh = load_mesh(file, settings.threads);
    result.ms.load = loading.ms();
    const std::unique_ptr<FurRenderer> renderer = starting.get();
    result.device = renderer->device_name();

    const Timer timer;
    report(progress, "growing fur", 0.2);
    GrownFur fur = grown_fur(std::move(mesh), settings.coat, with_masks(settings.lengths), settings.threads);
    const Mesh& grown = fur.mesh;
    const Roots& roots = fur.roots;
    const float spacing = fur.spacing;
    result.ms.roots = fur.roots_ms;

    FurView view;
    view.camera = view_of_sphere({0, 0, 0}, 1 + settings.coat.length * 0.6, settings.width, settings.height);
    view.layers = settings.layers > 0 ? settings.layers : layers_for(view.camera, settings.coat);
    view.passes = 1;
    // Roots must be found from the layers, and finding them farther off costs time: where faces would be off by more than a fifth of the
    // fur's length, there are more of them. Almost everywhere they are off by less than half of that worst case.
    SimplifiedMesh simpler;
    Mesh carrier;  // with shares of length for texture coordinates, so that they go through all that is done to layers
    if (!fur.lengths.empty()) {
        carrier = grown;
        carrier.uvs.clear();
        carrier.colours.clear();
        for (const float share : fur.lengths) carrier.uvs.emplace_back(share, 0.0f);
    }
    const Mesh& skin = fur.lengths.empty() ? grown : carrier;
    const bool many = grown.faces() > layer_faces(view.camera);
    if (many) simpler = simplified(skin, {.faces = layer_faces(view.camera), .error = settings.coat.length / 10.0}, settings.threads);
    Mesh layers = many ? std::move(simpler.mesh) : skin;
    layers.normals = continuous_normals(layers, NormalMode::angle, settings.threads);
    layers = refined(std::move(layers), layer_faces(view.camera));
    const std::vector<Vec3f> comb = combed(layers, mean_lean(settings.coat), settings.threads);
    std::vector<float> lengths;
    if (!fur.lengths.empty())
        for (const Vec2f& uv : layers.uvs) lengths.push_back(uv.x);
    const FurSkin surface{layers, comb, lengths, settings.coat};
    const bool pulled = length(settings.forces.gravity) > 0 || length(settings.forces.wind) > 0;
    const std::vector<Vec3f> pushes = pulled ? pushes_of(settled(surface, settings.forces, settings.threads)) : std::vector<Vec3f>{};
    result.ms.prepare = timer.ms() - result.ms.roots;

    const Timer step;
    const StrandGrid grid = strand_grid(grown, roots, {.reach = strand_reach(settings.coat, spacing, view.layers), .off = static_cast<float>(simpler.estimated_error / 2), .threads = settings.threads});
    result.ms.grid = step.ms();
    renderer->load({.mesh = &layers, .comb = &comb, .lengths = lengths.empty() ? nullptr : &lengths, .pushes = pulled ? &pushes : nullptr, .grid = &grid, .coat = settings.coat, .spacing = spacing});
    report(progress, "drawing", 0.5);
    FurFrames frames = renderer->draw(view);
    result.picture = shown_fur(frames);
    result.ms.first_frame = timer.ms();
    result.faces = grown.faces();
    result.strands = roots.roots.size();
    result.bare = static_cast<double>(fur.bare) / static_cast<double>(fur.bare + roots.roots.size());
    result.layers = view.layers;
    result.passes = settings.passes;
    result.layer_faces = layers.faces();
    result.notes = grown.notes;
    if (settings.passes > 1) {
        view.passes = settings.passes;
        frames = renderer->draw(view);
        result.picture = shown_fur(frames);
    }
    if (settings.reference_samples > 0) {
        // On the mesh itself: what its simplification changes counts as an error of the layers.
        const Timer tracing;
        const StrandCurves curves = curves_of(fur, settings.coat, 8, settings.forces, settings.threads);
        const FurFrames reference = trace_fur(curves, grown, settings.coat, view, settings.reference_samples, settings.threads, progress, fur.lengths);
        result.score = fur_score(frames, reference, settings.threads);
        result.score->reference_ms = tracing.ms();
        result.score->samples = settings.reference_samples;
        result.beside = side_by_side(result.picture, shown_fur(reference));
    }
    if (settings.film.frames > 0) {
        report(progress, "filming", 0.7);
        film_fur(*renderer, surface, view, settings.forces, settings.film, settings.threads);
    }
    std::ranges::sort(frames.frame_ms);
    result.ms.frame_median = frames.frame_ms[frames.frame_ms.size() / 2];
    if (settings.measure) {
        report(progress, "measuring", 0.9);
        // How even strands are is asked of the places where they grow: with those that bare skin lacks.
        const Roots all = fur.bare > 0 ? grow_roots(grown, {.count = static_cast<std::uint32_t>(settings.coat.strands), .threads = settings.threads}) : Roots{};
        const Roots& measured = fur.bare > 0 ? all : roots;
        std::vector<std::uint32_t> chances;
        for (const Root& root : measured.roots) chances.push_back(strand_chance(root.position));
        result.evenness = evenness(grown, measured, likeness(measured, chances, settings.threads), {.extent = 1, .threads = settings.threads});
    }
    result.frames = std::move(frames);
    report(progress, "drawing", 1);
    return result;
}

}  // namespace relievo
