// Meshes unwrapped into one picture, made to be drawn with relief: for tests, and where there is no mesh at hand.
#pragma once

#include "core/mesh.h"

#include <span>
#include <string_view>

namespace relievo {

// All charts of a mesh lie in [0,1]^2, apart from each other, and cover as much of the picture as of the mesh in proportion, but for what
// bends: the torus' outer rim is stretched, its inner one squeezed.
//   cube      edge 1, six square charts
//   cylinder  radius 0.5, height 1: its side, cut open, and two discs
//   torus     radii 0.6 and 0.25, cut into four charts
struct UnwrappedShape {
    std::string_view id;
    std::string_view summary;
    Mesh (*make)();
};
std::span<const UnwrappedShape> unwrapped_shapes();
const UnwrappedShape* find_unwrapped_shape(std::string_view id);

}  // namespace relievo
