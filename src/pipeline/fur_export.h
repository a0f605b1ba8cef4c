// Fur as files that other programs open, in the space and the units of the mesh it grows on.
#pragma once

#include "core/progress.h"
#include "fur/coat.h"
#include "fur/fur_motion.h"
#include "pipeline/grown_fur.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace relievo {

struct FurExportSettings {
    Coat coat;
    Growth growth;    // where fur is shorter and which way it lies; pictures are read here
    FurForces forces;  // that hold the fur
    int pieces = 8;   // straight ones of each strand, at least 1
    int layers = 0;   // of a .glb; 0: as many as show no gaps
    int atlas = 0;    // texels a side of its texture; 0: as the strands ask
    int threads = 0;
};

struct FurExport {
    std::size_t strands = 0, points = 0;  // points: of strands as curves
    std::size_t layers = 0;               // of a .glb
    std::vector<std::string> notes;
};

// Writes the fur that `coat` grows on the mesh to each file, as its ending says: strands as .hair, .obj or .ply (assets/strand_file.h), layers with
// a texture as .glb (assets/shells_gltf.h). No device is
// needed. Throws Error, before anything is grown for endings that are not known.
FurExport export_fur(const std::filesystem::path& mesh, const std::vector<std::string>& files, const FurExportSettings& settings, const Progress& progress = {});

}  // namespace relievo
