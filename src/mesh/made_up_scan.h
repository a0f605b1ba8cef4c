// A closed surface as a laser scanner would leave it, of any size: for tests and benchmarks that should not need anyone's data.
#pragma once

#include "core/mesh.h"

#include <cstdint>

namespace relievo {

struct MadeUpScan {
    std::uint32_t faces = 1000000;  // about; at least 8
    double relief = 0.25;           // height of the hills and folds, in radii of the sphere under them
    double noise = 0.15;            // of the range, in distances between neighbouring samples
    std::uint32_t seed = 1;
    int threads = 0;
};

// A sphere of radius 1 in hills of six sizes (summed value noise of halving size and height), sampled row by row as scanners do:
// parallels with as many samples as their length asks for, zipped together by the shorter diagonal, every sample off along its ray by
// noise. Vertices and faces come in scan order, their valences vary from 3 to 9 as in merged range images. Closed, genus 0, oriented
// outwards.
Mesh made_up_scan(const MadeUpScan& settings);

}  // namespace relievo
