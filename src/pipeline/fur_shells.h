// Grown fur as layers and one texture, for programs that know nothing of it.
#pragma once

#include "assets/shells_gltf.h"
#include "pipeline/grown_fur.h"

#include <string>
#include <vector>

namespace relievo {

struct ShellSettings {
    int layers = 0;               // 0: as many as show no gaps between them, 12 to 32
    int atlas = 0;                // texels a side; 0: 2048, or 4096 where strands would be thinner than two texels
    std::size_t faces = 40000;    // of the mesh that is pushed out, at most
    int threads = 0;
};

struct FurShells {
    ShellScene scene;
    int charts = 0;
    double texel = 0;             // width, in fur space
    double covered = 0;           // share of the skin in which strands stand
    std::vector<std::string> notes;
};

// `fur` gets its normals. Throws Error.
FurShells fur_shells(GrownFur& fur, const Coat& coat, const FurForces& forces, const ShellSettings& settings);

}  // namespace relievo
