// A mesh file in fur of lapped patches.
#pragma once

#include "fur/lapped.h"
#include "pipeline/fur_picture.h"
#include "render/layers_renderer.h"

#include <filesystem>
#include <span>

namespace relievo {

struct LappedFurSettings {
    CombPaint comb;            // the picture is read here
    Coat coat;                 // its number of strands, length, lean, width and colours; what sets strands apart from each other is not in a texture
    int texels = 128;          // edge of the square of strands, a power of two
    double density = 0.2;      // strands per texel of it; with the number of strands it says how large a patch is
    std::uint32_t seed = 1;
    int layers = 16;
    LayersLight light{.ambient = 0.25f, .diffuse = 0.75f, .specular = 0.25f, .power = 32};
    bool fit_light = false;    // to the reference, where there is one
    int width = 1280, height = 800;
    int passes = 16;
    std::string device;
    bool measure = false;
    int reference_samples = 0; // the coat's own strands as curves
    int threads = 0;
};

// The mesh in fur space with continuous normals, as patches grow on it. Throws Error.
PaintedSkin lapped_skin(Mesh mesh, const CombPaint& comb = {}, int threads = 0);

// What a mesh wears and what draws it. `mesh` is in fur space and has unit normals.
struct LappedDress {
    Mesh base;                 // simplified where faces are far smaller than patches, cut finer where they are larger
    Lapped patches;
    Image8 texture;
    DirectionMap fur, colour;
    double radius = 0;         // of a patch, in fur space
    LayersModel model(const LappedFurSettings& settings) const;
};
// `painted` is that of the mesh's vertices (empty: nothing).
LappedDress lapped_dress(const Mesh& mesh, const LappedFurSettings& settings, std::span<const PaintedLean> painted = {});

// Throws Error.
FurPicture lapped_picture(const std::filesystem::path& mesh, const LappedFurSettings& settings, const Progress& progress = {});

}  // namespace relievo
