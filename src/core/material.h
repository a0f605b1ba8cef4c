// A material as every stage sees it: heights, normals and colours with the numbers that give them size.
#pragma once

#include "core/height_field.h"
#include "core/image.h"

#include <optional>
#include <string>
#include <vector>

namespace relievo {

struct Material {
    std::string name;

    HeightField height;              // [0,1], 1 is the top; empty when only normals were given
    std::optional<ImageF> normal;    // 3 channels, unit vectors, tangent space, +Y along +v; may differ in size from the height
    std::optional<Image8> colour;    // 4 channels, sRGB-encoded RGB and alpha; may differ in size from the height

    float height_scale = 0.05f;             // amplitude of the relief in UV units of the texture
    float zero_level = 1.0f;                // height at which the polygon lies: 1 = carved below it, 0 = raised above it
    std::optional<float> physical_size_m;   // edge length of one repeat, metres

    std::vector<std::string> notes;  // what was assumed or corrected on loading, one sentence each, with the evidence
};

}  // namespace relievo
