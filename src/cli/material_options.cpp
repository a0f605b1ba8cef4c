#include "cli/material_options.h"

#include <CLI/CLI.hpp>

namespace relievo {

void add_material_options(CLI::App& verb, MaterialSource& source) {
    verb.add_option("--material", source.folder, "folder with colour, height and normal maps, or the id of a procedural one (relievo list scenes)");
    verb.add_option("--colour", source.colour, "colour map, instead of or beside a folder");
    verb.add_option("--height", source.height, "height map, likewise");
    verb.add_option("--normal", source.normal, "normal map, likewise");
    verb.add_option("--texels", source.procedural_size, "edge of a procedural material's maps, in texels")
        ->check(CLI::Range(1, 8192))
        ->capture_default_str();
    verb.add_option("--seed", source.seed, "seed of a procedural material")->capture_default_str();
    verb.add_option("--threads", source.threads, "threads to use (0: all cores)")->check(CLI::NonNegativeNumber);
}

}  // namespace relievo
