// A material's maps, ready to draw and to judge: what it brought, completed by what can be computed from it.
#pragma once

#include "core/map_set.h"
#include "core/material.h"
#include "core/progress.h"
#include "pipeline/bake_machine.h"
#include "techniques/modifiers.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace relievo {

struct BakeOptions {
    int threads = 0;         // 0: all cores; the maps do not depend on it
    bool use_cache = true;   // read and write the disk cache of expensive maps (map_cache.h)
    Progress progress = {};
    BakeMachine* machine = nullptr;  // null: the CPU; the maps do not depend on it
};

struct BakedMaps {
    MapSet maps;
    float height_scale = 0;
    float zero_level = 1;
    std::optional<double> physical_size_m;
    std::vector<std::string> notes;  // the material's and those of the baking
    std::string input_hash;          // of heights, normals and colours
    bool from_cache = false;         // every expensive map came from the cache
    std::string device;              // that baked a map, or empty
};

// The maps that these techniques need under these options, with those that every picture is shaded by; each once.
std::vector<Map> maps_to_draw(std::span<const Technique* const> techniques, std::span<const DrawOptions> options);

// Height is always there (integrated from the normals where the material has none); normal, colour, pyramid and cone if wanted.
BakedMaps bake_maps(Material material, std::span<const Map> wanted, const BakeOptions& options);

}  // namespace relievo
