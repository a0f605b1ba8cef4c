// The maps a technique may read, as plain arrays. What each one means stands here, once.
#pragma once

#include "core/height_field.h"
#include "core/image.h"

#include <array>
#include <bitset>
#include <cstdint>
#include <vector>

namespace relievo {

enum class Map : std::uint8_t { height, normal, colour, max_pyramid, cone, conservative_cone, relaxed_cone, robust_cone, horizon, distance, cell_cone };
inline constexpr int map_count = 11;

// Every map, in the order of the enumeration: the index of a map in arrays, and its binding on a device.
inline constexpr std::array<Map, map_count> every_map = [] {
    std::array<Map, map_count> all{};
    for (int i = 0; i < map_count; ++i) all[static_cast<std::size_t>(i)] = static_cast<Map>(i);
    return all;
}();

using MapFlags = std::bitset<map_count>;  // a set of maps, by index
constexpr std::size_t index_of(Map map) { return static_cast<std::size_t>(map); }

// Largest corner height of groups of 2^k x 2^k bilinear cells. Level 0 has one node per cell, padded (with 0, never visited)
// to a multiple of 2^(levels-1) so that a Vulkan mip chain of the padded size has exactly these levels.
struct MaxPyramid {
    int cells_x = 0;  // cells of one period = texels of the height map
    int cells_y = 0;
    std::vector<ImageF> levels;
};

// Slices of the 3D distance map over the slab, the first at height 0 and the last at height 1.
inline constexpr int distance_slices = 64;

// Directions of the horizon map. A light is looked up between two of them, and what is narrower than they are apart blurs its shadow:
// with 16 that was the largest error on rounded relief, with 32 it is less than half of it (docs/concepts/modifiers.md).
inline constexpr int horizon_directions = 32;

// How far the roofs of a cell cone map reach, in cells ahead along both axes.
inline constexpr int near_roof_reach = 2;
inline constexpr int middle_roof_reach = 8;
inline constexpr int far_roof_reach = 32;
inline constexpr int cell_cone_quadrants = 4;

struct MapSet {
    HeightField height;
    std::vector<ImageF> normal;   // mip chain, 3 channels, unit vectors, tangent space, +Y along +v
    std::vector<Image8> colour;   // mip chain, 4 channels, sRGB-encoded
    MaxPyramid max_pyramid;       // empty until baked
    ImageF cone;                  // 2 channels: height, cone ratio (UV radius per unit of height, at most 1); empty until baked
    ImageF conservative_cone;     // like cone, of maps/conservative_cone.h
    ImageF relaxed_cone;          // like cone, of maps/relaxed_cone.h
    ImageF robust_cone;           // like cone, of maps/robust_cone.h
    ImageF horizon;               // 32 channels: the horizon's elevation by direction, coded (maps/horizon_map.h); empty until baked
    ImageF distance;              // 1 channel, distance_slices slices stacked upward: maps/distance_map.h; empty until baked
    ImageF cell_cone;             // 4 channels a cell, 4 quadrants stacked upward: maps/cell_cone.h; empty until baked
};

}  // namespace relievo
