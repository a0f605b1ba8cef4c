#include "pipeline/fur_picture.h"

#include "assets/image_file.h"
#include "assets/mesh_file.h"
#include "core/warm_memory.h"
#include "fur/likeness.h"
#include "fur/strand_grid.h"
#include "pipeline/fur_reference.h"
#include "pipeline/fur_painter.h"
#include "pipeline/timer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <optional>
#include <utility>

namespace relievo {

void write_fur_picture(const std::filesystem::path& png, const Image8& picture) { write_png(png, picture, FirstRow::top); }

FurPicture fur_picture(const std::filesystem::path& file, const FurSettings& settings, const Progress& progress) {
    FurPicture result;
    result.mode = settings.mode;
    FurView view;
    view.camera = view_of_sphere({0, 0, 0}, 1 + settings.coat.length * 0.6, settings.width, settings.height);
    view = with_layers(view, settings.layers > 0 ? settings.layers : layers_for(settings.mode, view.camera, settings.coat));
    view.passes = 1;
    // The device starts while the file is read.
    auto starting = std::async(std::launch::async, [&] {
        auto painter = std::make_unique<FurPainter>(settings.mode, settings.device);
        // The count of roots comes within a few hundredths of what is asked for.
        painter->expect(view, static_cast<std::size_t>(static_cast<double>(settings.coat.strands) * 1.05));
        return painter;
    });
    report(progress, "loading " + file.filename().string(), 0);
    const Timer loading;
    Mesh mesh = load_mesh(file, settings.threads);
    result.ms.load = loading.ms();
    // The device takes longer to start than most files to be read. Meanwhile: what growing and drawing will take, of darts, roots and strands, of the mesh that is to be
    // simplified, and of the picture. Counted with a bunny and a dragon, which then touch a third of the new memory that they touched before.
    constexpr std::size_t strand_bytes = 120, face_bytes = 120, pixel_bytes = 8;
    std::optional<WarmMemory> warm(std::in_place, static_cast<std::size_t>(settings.coat.strands) * strand_bytes + mesh.faces() * face_bytes +
                                                      static_cast<std::size_t>(settings.width) * static_cast<std::size_t>(settings.height) * pixel_bytes,
                                   [&] { return starting.wait_for(std::chrono::seconds(0)) != std::future_status::ready; });
    const std::unique_ptr<FurPainter> painter = starting.get();
    warm->hand_over();
    result.device = painter->device_name();

    const Timer timer;
    report(progress, "growing fur", 0.2);
    GrownFur fur = grown_fur(std::move(mesh), settings.coat, with_pictures(settings.growth), settings.threads);
    const Mesh& grown = fur.mesh;
    const Roots& roots = fur.roots;
    result.ms.roots = fur.roots_ms;

    const FurPainter::Loaded loaded = painter->load(fur, settings.coat, settings.forces, nearest_view(view, settings.film, settings.mode, settings.coat, settings.layers == 0), settings.threads);
    result.ms.grid = loaded.grid_ms;
    result.ms.prepare = timer.ms() - result.ms.roots - result.ms.grid;
    report(progress, "drawing", 0.5);
    FurFrames frames = painter->draw(view);
    result.picture = shown_fur(frames);
    result.ms.first_frame = timer.ms();
    warm.reset();
    if (!frames.stages.empty()) result.stages = {frames.stages.front()};
    result.faces = grown.faces();
    result.strands = roots.roots.size();
    result.bare = static_cast<double>(fur.bare) / static_cast<double>(fur.bare + roots.roots.size());
    result.layers = view.layers;
    result.passes = settings.passes;
    result.layer_faces = loaded.layer_faces;
    result.notes = grown.notes;
    if (settings.passes > 1) {
        view.passes = settings.passes;
        frames = painter->draw(view);
        result.picture = shown_fur(frames);
    }
    if (settings.reference_samples > 0) {
        // On the mesh itself: what its simplification changes counts as an error of the layers.
        const Timer tracing;
        const StrandCurves curves = curves_of(fur, settings.coat, reference_pieces, settings.forces, settings.threads);
        const FurFrames reference = trace_fur(curves, grown, settings.coat, view, settings.reference_samples, settings.threads, progress, fur.lengths);
        result.score = fur_score(frames, reference, settings.threads);
        result.score->reference_ms = tracing.ms();
        result.score->samples = settings.reference_samples;
        result.beside = side_by_side(result.picture, shown_fur(reference));
    }
    if (settings.film.frames > 0)
        result.steadiness = film_fur({.painter = *painter, .fur = fur, .coat = settings.coat, .forces = settings.forces, .view = view, .layers_adapt = settings.layers == 0}, settings.film, settings.threads, progress);
    if (!frames.stages.empty()) result.stages.push_back(frames.stages.back());
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
