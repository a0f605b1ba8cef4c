#include "pipeline/fur_export.h"

#include "assets/atomic_file.h"
#include "assets/mesh_file.h"
#include "assets/strand_file.h"
#include "core/error.h"
#include "core/parallel_for.h"
#include "fur/strand_albedo.h"
#include "pipeline/fur_shells.h"

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
    bool lines_wanted = false, shells_wanted = false;
    for (const std::string& file : files) {
        const std::string ending = std::filesystem::path(file).extension();
        (ending == ".glb" ? shells_wanted : lines_wanted) = true;
        if (ending != ".hair" && ending != ".obj" && ending != ".ply" && ending != ".glb")
            throw Error("export fur to", file, "its ending names no format of fur", "known: hair, obj, ply for strands, glb for layers");
    }
    report(progress, "loading " + mesh.filename().string(), 0);
    GrownFur fur = grown_fur(load_mesh(mesh, settings.threads), settings.coat, with_pictures(settings.growth), settings.threads);
    report(progress, "growing strands", 0.3);
    FurExport result{.strands = fur.roots.roots.size(), .notes = fur.mesh.notes};
    if (lines_wanted) {
        const StrandCurves curves = curves_of(fur, settings.coat, settings.pieces, settings.forces, settings.threads);
        const StrandLines lines = lines_of(curves, settings.coat, fur.sphere, settings.threads);
        result.points = lines.points.size();
        for (const std::string& file : files) {
            if (std::filesystem::path(file).extension() == ".glb") continue;
            report(progress, "writing " + file, 0.5);
            save_strands(file, lines, settings.threads);
        }
    }
    if (shells_wanted) {
        report(progress, "laying layers", 0.6);
        const FurShells shells = fur_shells(fur, settings.coat, settings.forces, {.layers = settings.layers, .atlas = settings.atlas, .threads = settings.threads});
        result.notes.insert(result.notes.end(), shells.notes.begin(), shells.notes.end());
        const std::string bytes = write_shells_glb(shells.scene);
        for (const std::string& file : files) {
            if (std::filesystem::path(file).extension() != ".glb") continue;
            report(progress, "writing " + file, 0.9);
            write_file_atomically(file, bytes);
            result.layers = shells.scene.layers.size();
        }
    }
    report(progress, "writing", 1);
    return result;
}

}  // namespace relievo
