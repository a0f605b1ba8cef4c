#include "pipeline/fur_picture.h"

#include "assets/image_file.h"
#include "assets/mesh_file.h"
#include "core/error.h"
#include "core/parallel_for.h"
#include "fur/comb.h"
#include "fur/refined.h"
#include "fur/roots.h"
#include "fur/strand_curves.h"
#include "fur/strand_grid.h"
#include "measure/flip.h"
#include "mesh/bounds.h"
#include "mesh/indexing.h"
#include "mesh/normals.h"
#include "mesh/repair.h"
#include "mesh/simplify.h"
#include "pipeline/fur_reference.h"
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

// Into fur space: the smallest sphere becomes the unit sphere. Works in double, as scans may lie far from their origin.
void into_fur_space(Mesh& mesh, const Sphere& sphere, int threads) {
    const double scale = 1 / sphere.radius;
    parallel_for(static_cast<int>(mesh.positions.size()), 65536, threads, [&](int begin, int end) {
        for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) mesh.positions[v] = Vec3f((Vec3d(mesh.positions[v]) - sphere.centre) * scale);
    });
}

// A studio's paper: lighter behind the middle, darker toward the edges and below.
Vec3f backdrop(double x, double y) {
    const double dx = x - 0.5, dy = y - 0.42, glow = std::exp(-3.0 * (dx * dx + dy * dy));
    const double v = 0.13 + 0.27 * glow;
    return Vec3f(Vec3d(v, v * 1.01, v * 1.03));
}

// Linear light, before the backdrop.
ImageF before_backdrop(const FurFrames& frames) {
    ImageF all(frames.colour.width, frames.colour.height, 3);
    for (int y = 0; y < all.height; ++y)
        for (int x = 0; x < all.width; ++x) {
            const Vec3f behind = backdrop((x + 0.5) / all.width, (y + 0.5) / all.height);
            const float open = 1 - frames.coverage(x, y);
            const float* c = frames.colour.at(x, y);
            all(x, y, 0) = c[0] + open * behind.x;
            all(x, y, 1) = c[1] + open * behind.y;
            all(x, y, 2) = c[2] + open * behind.z;
        }
    return all;
}

Image8 shown(const FurFrames& frames) {
    const ImageF linear = before_backdrop(frames);
    Image8 picture(linear.width, linear.height, 3);
    for (std::size_t i = 0; i < linear.texels.size(); ++i) picture.texels[i] = srgb_from_linear(linear.texels[i]);
    return picture;
}

Image8 side_by_side(const Image8& left, const Image8& right) {
    Image8 both(left.width + right.width, left.height, 3);
    for (int y = 0; y < left.height; ++y) {
        std::copy_n(left.at(0, y), left.width * 3, both.at(0, y));
        std::copy_n(right.at(0, y), right.width * 3, both.at(left.width, y));
    }
    return both;
}

FurScore score_of(const FurFrames& picture, const FurFrames& reference, int threads) {
    FurScore score;
    score.flip = flip(before_backdrop(picture), before_backdrop(reference), {.threads = threads}).mean;
    double sum = 0;
    std::size_t either = 0, inside = 0, open = 0;
    for (std::size_t p = 0; p < reference.coverage.texels.size(); ++p) {
        const float a = picture.coverage.texels[p], b = reference.coverage.texels[p];
        if (a > 0 || b > 0) {
            ++either;
            sum += std::abs(static_cast<double>(a) - static_cast<double>(b));
        }
        inside += b > 0.5f;
        open += b > 0.5f && a < 0.25f;
    }
    if (either > 0) score.coverage_error = sum / static_cast<double>(either);
    if (inside > 0) score.gaps = static_cast<double>(open) / static_cast<double>(inside);
    return score;
}

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
    if (mesh.faces() == 0) throw Error("grow fur on", mesh.name, "it has no faces");
    const std::unique_ptr<FurRenderer> renderer = starting.get();
    result.device = renderer->device_name();

    const Timer timer;
    report(progress, "growing fur", 0.2);
    // Points that no face uses would count as part of its size.
    std::vector<std::uint8_t> used(mesh.positions.size(), 0);
    for (const std::uint32_t v : mesh.indices) used[v] = 1;
    if (std::ranges::find(used, 0) != used.end()) mesh = indexed(std::move(mesh), settings.threads);
    const Sphere sphere = bounding_sphere(mesh.positions, settings.threads);
    if (!(sphere.radius > 0)) throw Error("grow fur on", mesh.name, "all its points are one");
    into_fur_space(mesh, sphere, settings.threads);
    Timer growing;
    const RootSettings wanted{.count = static_cast<std::uint32_t>(settings.coat.strands), .threads = settings.threads};
    Roots roots = grow_roots(mesh, wanted);
    if (static_cast<double>(roots.roots.size()) < 0.8 * wanted.count && wanted.count > 500) {
        // Faces lie on one another and had the area counted twice.
        mesh = repaired(std::move(mesh), settings.threads).mesh;
        if (mesh.faces() == 0) throw Error("grow fur on", file.filename().string(), "all its faces are collapsed or repeated");
        roots = grow_roots(mesh, wanted);
    }
    result.ms.roots = growing.ms();
    const auto spacing = static_cast<float>(std::sqrt(roots.area / static_cast<double>(std::max<std::size_t>(roots.roots.size(), 1))));

    FurView view;
    view.camera = view_of_sphere({0, 0, 0}, 1 + settings.coat.length * 0.6, settings.width, settings.height);
    view.layers = settings.layers > 0 ? settings.layers : layers_for(view.camera, settings.coat);
    view.passes = 1;
    // Roots must be found from the layers, and finding them farther off costs time: where faces would be off by more than a fifth of the
    // fur's length, there are more of them. Almost everywhere they are off by less than half of that worst case.
    SimplifiedMesh simpler;
    const bool many = mesh.faces() > layer_faces(view.camera);
    if (many) simpler = simplified(mesh, {.faces = layer_faces(view.camera), .error = settings.coat.length / 10.0}, settings.threads);
    Mesh layers = many ? std::move(simpler.mesh) : mesh;
    layers.normals = continuous_normals(layers, NormalMode::angle, settings.threads);
    layers = refined(std::move(layers), layer_faces(view.camera));
    const std::vector<Vec3f> comb = combed(layers, mean_lean(settings.coat), settings.threads);
    result.ms.prepare = timer.ms() - result.ms.roots;

    const Timer step;
    const StrandGrid grid = strand_grid(mesh, roots, {.reach = strand_reach(settings.coat, spacing, view.layers), .off = static_cast<float>(simpler.estimated_error / 2), .threads = settings.threads});
    result.ms.grid = step.ms();
    renderer->load({.mesh = &layers, .comb = &comb, .grid = &grid, .coat = settings.coat, .spacing = spacing});
    report(progress, "drawing", 0.5);
    FurFrames frames = renderer->draw(view);
    result.picture = shown(frames);
    result.ms.first_frame = timer.ms();
    result.faces = mesh.faces();
    result.strands = roots.roots.size();
    result.layers = view.layers;
    result.passes = settings.passes;
    result.layer_faces = layers.faces();
    result.notes = mesh.notes;
    if (settings.passes > 1) {
        view.passes = settings.passes;
        frames = renderer->draw(view);
        result.picture = shown(frames);
    }
    if (settings.reference_samples > 0) {
        // On the mesh itself: what its simplification changes counts as an error of the layers.
        const Timer tracing;
        mesh.normals = continuous_normals(mesh, NormalMode::angle, settings.threads);
        const StrandCurves curves = strand_curves(mesh, combed(mesh, mean_lean(settings.coat), settings.threads), roots, settings.coat, spacing, 8, settings.threads);
        const FurFrames reference = trace_fur(curves, mesh, settings.coat, view, settings.reference_samples, settings.threads, progress);
        result.score = score_of(frames, reference, settings.threads);
        result.score->reference_ms = tracing.ms();
        result.score->samples = settings.reference_samples;
        result.beside = side_by_side(result.picture, shown(reference));
    }
    std::ranges::sort(frames.frame_ms);
    result.ms.frame_median = frames.frame_ms[frames.frame_ms.size() / 2];
    if (settings.measure) {
        report(progress, "measuring", 0.9);
        result.evenness = evenness(mesh, roots, {}, {.extent = 1, .threads = settings.threads});
    }
    report(progress, "drawing", 1);
    return result;
}

}  // namespace relievo
