// The eight configurations and six meshes of the 2009 thesis, with its method and with ours, scored against strands as curves.
#pragma once

#include "core/mesh.h"
#include "core/progress.h"
#include "report/fur_replication.h"

#include <filesystem>
#include <string>
#include <vector>

namespace relievo {

struct ReplicateFurSettings {
    std::filesystem::path meshes;         // a folder with scans of the bunny, the dragon, the armadillo and the buddha; empty: stand-ins
    std::vector<std::string> only;        // meshes by name; empty: all six
    std::vector<double> heights, densities;  // of the published ones, percent; empty: all
    std::filesystem::path state;          // .json: what is measured is kept there after every unit and not measured again; empty: nowhere
    std::filesystem::path pictures;       // a folder for pictures of classic, lapped, strands and the reference side by side; empty: nowhere
    std::filesystem::path page, csv;      // empty: nowhere
    double seconds = 0;                   // begin no further unit after so long; 0: no limit
    int width = 1280, height = 800;
    int passes = 8;                       // frames of a round, averaged for `flip` and coverage
    int rounds = 2;                       // all trials in turn, so often
    int samples = 8;                      // rays a pixel of the reference
    std::string device;
    std::string command;                  // for the page
    int threads = 0;
};

// Throws Error; also where the state was measured with other settings.
FurReplication replicate_fur(const ReplicateFurSettings& settings, const Progress& progress = {});

// A torus of radius 1 and 0.4 around the y axis: `around` times `across` quadrilaterals, cut in two. A cube of edge 2 has 12 faces.
Mesh torus_mesh(std::uint32_t around, std::uint32_t across);
Mesh cube_mesh();

}  // namespace relievo
