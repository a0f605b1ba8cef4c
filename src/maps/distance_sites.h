// What the 3D distance map is made from, shared by all who make it: points whose distances are taken, and what of a distance is stored.
// The two lemmas by which this is safe stand in distance_sites.cpp.
#pragma once

#include "core/height_field.h"
#include "core/image.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace relievo {

struct DistanceSites {
    ImageF heights;     // of the voxels' columns, raised where cells are steep
    ImageF correction;  // c^2 of lemma 1
    float side_u = 0, side_v = 0, side_z = 0;  // of a voxel, in heights
    float diagonal2 = 0;                       // its squared diagonal, D of lemma 2
};

// height_scale as distance_map takes it.
DistanceSites distance_sites(const HeightField& field, float height_scale);

// Devices may keep 8 bits of a filter's weights (VkPhysicalDeviceLimits::subTexelPrecisionBits), so that they read up to 1/512 of a
// voxel aside, along each axis; d grows by at most the way.
inline constexpr float distance_filter_slack = 1.0f / 256;

// f of lemma 2, less what rounding and filters may add, rounded down to a half float (10 bits of fraction, no subnormals). Never falls
// where `squared` rises.
inline float stored_distance(float squared, float diagonal2) {
    const float quarter = diagonal2 / 4;
    const float diagonal = std::sqrt(diagonal2);
    const float value = squared >= 2 * quarter ? std::sqrt(squared - quarter) : (squared - quarter) / (0.5f * diagonal);
    const float low = value - diagonal * distance_filter_slack - 1e-6f;
    if (std::abs(low) < 0x1p-14f) return low < 0 ? -0x1p-14f : 0.0f;
    std::uint32_t bits = std::bit_cast<std::uint32_t>(low);
    if (low < 0) bits += 0x1fffu;  // away from zero
    return std::bit_cast<float>(bits & ~0x1fffu);
}

}  // namespace relievo
