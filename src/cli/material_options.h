// The options by which every verb is told which material to use.
#pragma once

#include "pipeline/material_source.h"

namespace CLI {
class App;
}

namespace relievo {

// Adds --material DIR|ID, --colour, --height, --normal, --texels and --seed to a verb that takes one material.
void add_material_options(CLI::App& verb, MaterialSource& source);

}  // namespace relievo
