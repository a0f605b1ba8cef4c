// One map of one material, as a file.
#pragma once

#include "core/map_set.h"
#include "core/progress.h"
#include "pipeline/material_source.h"

#include <string>

namespace relievo {

struct BakeSettings {
    MaterialSource material;
    Map map = Map::height;
    std::string out;  // .png (8 or 16 bit, values in [0,1]; normals as n/2 + 1/2) or .exr (32-bit float, unscaled)
    bool use_cache = true;
    int threads = 0;
    std::string device = "cpu";  // who bakes, as BakeMachine::named takes it; one map seldom earns back what starting a device takes
};

struct BakedMap {
    int width = 0;
    int height = 0;
    double ms = 0;      // of the baking alone, without loading, writing and a device's start
    double start_ms = 0;  // of that start
    std::string device;   // that baked, or empty: the CPU did
    int threads = 0;
    bool from_cache = false;
    std::vector<std::string> notes;
};

BakedMap bake_map(const BakeSettings& settings, const Progress& progress);

}  // namespace relievo
