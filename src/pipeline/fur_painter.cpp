#include "pipeline/fur_painter.h"

#include "fur/carried_values.h"
#include "fur/comb.h"
#include "fur/refined.h"
#include "fur/rooted_strands.h"
#include "fur/strand_grid.h"
#include "mesh/normals.h"
#include "mesh/simplify.h"
#include "render/fur_renderer.h"
#include "render/strand_renderer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <future>
#include <map>
#include <utility>

namespace relievo {

namespace {

double pixels_per_unit(const MeshView& view) {
    return view.height / (length(view.camera.eye - view.camera.target) * 2 * std::tan(view.camera.fov_y_rad / 2));
}

// Layers are drawn from a mesh of faces of some hundred pixels: smaller ones cost more than the pixels in them, and how the skin lies
// is told by roots, which grow on the mesh itself. In the picture the unit sphere covers a disc; a surface's two sides and folds cover
// about six times as much.
std::size_t layer_faces(const MeshView& view) {
    const double radius_px = pixels_per_unit(view);
    constexpr double pixels_per_face = 360;
    return static_cast<std::size_t>(std::clamp(6 * 3.14 * radius_px * radius_px / pixels_per_face, 6000.0, 1e6));
}

struct LayerMesh {
    Mesh mesh;
    std::vector<Vec3f> comb;
    std::vector<float> lengths;
    double off = 0;  // its worst distance from the mesh it stands for
};

// Plotted strands need the skin for what it hides, and as the surface that light meets, which is smooth where the fur is long: bumps
// smaller than its length only throw shadows that traced strands do not have.
std::size_t skin_faces(const MeshView& view, const Coat& coat) {
    constexpr double faces = 16, least = 2000;  // on the unit sphere, where each has 0.8 squares of the fur's length
    const double length = std::max(static_cast<double>(coat.length), 1e-3);
    return std::min(layer_faces(view), static_cast<std::size_t>(std::max(faces / (length * length), least)));
}

LayerMesh layer_mesh(const GrownFur& fur, FurKind kind, const Coat& coat, const MeshView& view, int threads) {
    // Roots must be found from the layers, and finding them farther off costs time: where faces would be off by more than a fifth of the
    // fur's length, there are more of them. Almost everywhere they are off by less than half of that worst case.
    const bool carries = !fur.lengths.empty() || !fur.painted.empty();
    const Mesh carrier = carries ? carrying(fur.mesh, fur.lengths, fur.painted) : Mesh{};
    const Mesh& skin = carries ? carrier : fur.mesh;
    SimplifiedMesh simpler;
    // Where skin is bare it is seen.
    const bool covered = kind == FurKind::strands && fur.bare == 0;
    const std::size_t faces = covered ? skin_faces(view, coat) : layer_faces(view);
    const bool many = skin.faces() > faces;
    if (many) simpler = simplified(skin, {.faces = faces, .error = static_cast<double>(coat.length) / 10, .fast = covered}, threads);
    LayerMesh layers{.mesh = many ? std::move(simpler.mesh) : skin, .comb = {}, .lengths = {}, .off = simpler.estimated_error};
    layers.mesh.normals = continuous_normals(layers.mesh, NormalMode::angle, threads);
    layers.mesh = refined(std::move(layers.mesh), faces);
    SkinPaint values = taken_off(layers.mesh, !fur.lengths.empty(), !fur.painted.empty());
    layers.comb = combed(layers.mesh, mean_lean(coat), threads, values.painted);
    layers.lengths = std::move(values.lengths);
    return layers;
}

}  // namespace

FurPainter::FurPainter(FurKind kind, const std::string& device, bool validation) : kind_(kind) {
    assert(kind == FurKind::strands || kind == FurKind::shells);
    if (kind == FurKind::strands) strands_ = std::make_unique<StrandRenderer>(device, validation);
    else shells_ = std::make_unique<FurRenderer>(device, validation);
}
FurPainter::~FurPainter() = default;

std::string FurPainter::device_name() const { return strands_ ? strands_->device_name() : shells_->device_name(); }
std::vector<std::string> FurPainter::validation_messages() const { return strands_ ? strands_->validation_messages() : shells_->validation_messages(); }

void FurPainter::expect(const FurView& view, std::size_t strands) {
    if (strands_) strands_->expect(view, strands);
}

FurPainter::Loaded FurPainter::load(GrownFur& fur, const Coat& coat, const FurForces& forces, const FurView& view, int threads) {
    Loaded result;
    fur_ = &fur;
    coat_ = &coat;
    threads_ = threads;
    skin_vertex_.clear();
    if (strands_ && fur.mesh.normals.empty()) fur.mesh.normals = continuous_normals(fur.mesh, NormalMode::angle, threads);
    // What simplifies a mesh has one thread: strands get the rest meanwhile.
    auto layering = std::async(std::launch::async, [&grown = std::as_const(fur), &coat, &view, kind = kind_, threads] { return layer_mesh(grown, kind, coat, view.camera, threads); });
    if (strands_) {
        skin_comb_ = comb_of(fur, coat, threads);
        strands_on_skin_ = rooted_strands(fur.mesh, skin_comb_, fur.lengths, fur.roots, threads);
    }
    LayerMesh layers = layering.get();
    layers_ = std::move(layers.mesh);
    layers_comb_ = std::move(layers.comb);
    layers_lengths_ = std::move(layers.lengths);
    const std::vector<float>* lengths = layers_lengths_.empty() ? nullptr : &layers_lengths_;
    result.layer_faces = layers_.faces();
    if (strands_) {
        strands_->load({.mesh = &layers_, .comb = &layers_comb_, .lengths = lengths, .strands = &strands_on_skin_, .coat = coat, .spacing = fur.spacing});
    } else {
        const auto start = std::chrono::steady_clock::now();
        const StrandGrid grid = strand_grid(fur.mesh, fur.roots, {.reach = strand_reach(coat, fur.spacing, layers_of(view)), .off = static_cast<float>(layers.off / 2), .threads = threads});
        result.grid_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
        shells_->load({.mesh = &layers_, .comb = &layers_comb_, .lengths = lengths, .pushes = nullptr, .grid = &grid, .coat = coat, .spacing = fur.spacing});
    }
    if (length(forces.gravity) > 0 || length(forces.wind) > 0) push(pushes_of(settled(skin(), forces, threads)));
    return result;
}

FurSkin FurPainter::skin() const {
    if (strands_) return {fur_->mesh, skin_comb_, fur_->lengths, *coat_};
    return {layers_, layers_comb_, layers_lengths_, *coat_};
}

void FurPainter::push(const std::vector<Vec3f>& pushes) {
    if (shells_) {
        shells_->push(pushes);
        return;
    }
    if (skin_vertex_.empty()) {
        // Simplification keeps vertices where they are. What refinement adds between them is left as the coat alone bends it.
        std::map<std::array<float, 3>, std::int64_t> places;
        for (std::size_t v = 0; v < fur_->mesh.positions.size(); ++v) {
            const Vec3f& p = fur_->mesh.positions[v];
            places.try_emplace({p.x, p.y, p.z}, static_cast<std::int64_t>(v));
        }
        for (const Vec3f& p : layers_.positions) {
            const auto it = places.find({p.x, p.y, p.z});
            skin_vertex_.push_back(it == places.end() ? -1 : it->second);
        }
    }
    std::vector<Vec3f> of_layers(skin_vertex_.size());
    for (std::size_t v = 0; v < of_layers.size(); ++v)
        if (skin_vertex_[v] >= 0) of_layers[v] = pushes[static_cast<std::size_t>(skin_vertex_[v])];
    strands_->push(at_strands(fur_->mesh, fur_->roots, pushes, threads_), of_layers);
}

FurFrames FurPainter::draw(const FurView& view) { return strands_ ? strands_->draw(view) : shells_->draw(view); }

double layers_for(FurKind kind, const MeshView& view, const Coat& coat) {
    if (kind == FurKind::strands) {
        // An arc of length l that turns by a is off n chords by l a / (8 n^2). Locks turn strands by about twice their sway; a turn of a
        // helix takes eight chords.
        const double turn = coat.bend + 2 * coat.lock, pixels = coat.length * pixels_per_unit(view);
        const double straight = std::ceil(std::sqrt(pixels * turn / (8 * 0.25))), curled = coat.curl_radius > 0 ? std::ceil(8 * coat.curl_turns) : 0;
        return std::clamp(std::max(straight, curled), 3.0, 64.0);
    }
    const double bend = std::max(coat.bend, 1e-3f), rise = coat.length * (std::sin(coat.tilt + bend) - std::sin(static_cast<double>(coat.tilt))) / bend;
    return std::clamp(rise * pixels_per_unit(view) / 2, 6.0, 48.0);
}

}  // namespace relievo
