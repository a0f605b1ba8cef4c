#include "pipeline/fur_export.h"

#include "assets/mesh_file.h"
#include "assets/strand_file.h"
#include "core/error.h"
#include "core/parallel_for.h"
#include "fur/strand_albedo.h"
#include "pipeline/grown_fur.h"

namespace relievo {

namespace {

// Out of fur space, in double, as scans may lie far from their origin.
StrandLines lines_of(const StrandCurves& curves, const Coat& coat, const Sphere& sphere, int threads) {
    StrandLines lines;
    const auto pieces = static_cast<std::size_t>(curves.pieces);
    lines.pieces.assign(curves.strands.size(), static_cast<std::uint32_t>(pieces));
    lines.points.resize(curves.points.size());
    lines.radii.resize(curves.points.size());
    lines.colours.resize(curves.points.size());
    parallel_for(static_cast<int>(curves.strands.size()), 4096, threads, [&](int begin, int end) {
        for (auto s = static_cast<std::size_t>(begin); s < static_cast<std::size_t>(end); ++s)
            for (std::size_t k = 0; k <= pieces; ++k) {
                const std::size_t i = s * (pieces + 1) + k;
                lines.points[i] = Vec3f(Vec3d(curves.points[i]) * sphere.radius + sphere.centre);
                lines.radii[i] = static_cast<float>(static_cast<double>(curves.radii[i]) * sphere.radius);
                lines.colours[i] = Vec3f(strand_albedo(coat, curves.strands[s], static_cast<double>(k) / static_cast<double>(pieces)));
            }
    });
    return lines;
}

}  // namespace

FurExport export_fur(const std::filesystem::path& mesh, const std::vector<std::string>& files, const FurExportSettings& settings, const Progress& progress) {
    for (const std::string& file : files)
        if (const std::string ending = std::filesystem::path(file).extension(); ending != ".hair" && ending != ".obj" && ending != ".ply")
            throw Error("export fur to", file, "its ending names no format of fur", "known: hair, obj, ply");
    report(progress, "loading " + mesh.filename().string(), 0);
    GrownFur fur = grown_fur(load_mesh(mesh, settings.threads), settings.coat, with_masks(settings.lengths), settings.threads);
    report(progress, "growing strands", 0.3);
    const StrandCurves curves = curves_of(fur, settings.coat, settings.pieces, settings.forces, settings.threads);
    const StrandLines lines = lines_of(curves, settings.coat, fur.sphere, settings.threads);
    for (const std::string& file : files) {
        report(progress, "writing " + file, 0.6);
        save_strands(file, lines, settings.threads);
    }
    report(progress, "writing", 1);
    return {.strands = lines.pieces.size(), .points = lines.points.size(), .notes = fur.mesh.notes};
}

}  // namespace relievo
