// Where a material comes from: a folder or files of somebody else's, or one of our procedural ones.
#pragma once

#include "core/material.h"

#include <string>

namespace relievo {

struct MaterialSource {
    std::string folder = {};        // a folder, or the id of a procedural material; empty when files are named one by one
    std::string colour = {}, height = {}, normal = {};  // explicit files; each optional
    int procedural_size = 512;      // texels along an edge
    unsigned seed = 1;
    int threads = 0;
};

// Finds the material without reading a picture, and throws what load_source would if it is not there.
void check_source(const MaterialSource& source);

// Throws Error when nothing usable is there; what was assumed stands in the material's notes.
Material load_source(const MaterialSource& source);

}  // namespace relievo
