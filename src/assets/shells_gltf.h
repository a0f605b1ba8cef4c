// Fur in layers as a glTF file that any viewer shows.
#pragma once

#include "core/image.h"
#include "core/vec.h"

#include <cstdint>
#include <string>
#include <vector>

namespace relievo {

struct ShellScene {
    std::string name;
    Vec3d centre;        // where the origin of the positions lies
    double radius = 1;   // and how long their unit is there
    std::vector<Vec3f> skin, skin_normals;  // of each vertex
    std::vector<Vec2f> uvs;                 // v = 0 at the bottom
    std::vector<std::uint32_t> indices;     // of the skin and of every layer
    Vec3f skin_colour;                      // linear
    struct Layer {
        std::vector<Vec3f> positions, normals;
        float cutoff = 0;  // texels of less alpha are not shown
        Vec3f shade;       // by which the texture's colour is multiplied, linear, in [0,1]
    };
    std::vector<Layer> layers;
    Image8 texture;        // RGBA, row 0 at the bottom
};

// One mesh of as many primitives as there are layers and one more for the skin, which is opaque; the layers share indices, texture coordinates and the
// texture, which stands in the file as PNG, and are of alpha mode MASK: there is nothing to sort. Core glTF 2.0, no extension. Throws Error where it
// grows beyond the 4 GiB of the format.
std::string write_shells_glb(const ShellScene& scene);

}  // namespace relievo
