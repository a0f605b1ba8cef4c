// Materials made from nothing but a seed: tileable, of any size, with 16-bit heights. Colour and height come from one geometry.
#pragma once

#include "core/material.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace relievo {

struct ProceduralMaterial {
    std::string_view id;
    std::string_view title;
    std::string_view summary;  // what it is made of, one line
    float physical_size_m;     // edge length of one repeat
};

// In the order in which they are shown.
std::span<const ProceduralMaterial> procedural_materials();
const ProceduralMaterial* find_procedural_material(std::string_view id);  // nullptr if there is none

// Texels of one period: height in [0,1], each value exactly k/65535, the lowest 0 and the highest 1 (from 512 texels up); colour
// RGBA8, sRGB albedo without light or shadow in it. Both size x size, row 0 at v = 0, wrap = repeat, power of two or not. The
// normal is left to the baker and height_scale to the caller (Material's defaults). Features have their size in UV, so any two
// sizes look alike; a map under 512 texels is averaged from at least 512 samples across.
// The same id, size and seed give the same bytes for any number of threads (0: all cores).
// Throws Error for an unknown id (with the nearest known one) and for a size outside [1, 16384].
Material procedural_material(std::string_view id, int size, std::uint32_t seed, int threads);

}  // namespace relievo
