// How far each site is below the slice, squared, less its correction.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "distance.glsl"

layout(set = 0, binding = 0, std430) readonly buffer Heights { float heights[]; };
layout(set = 0, binding = 1, std430) readonly buffer Corrections { float corrections[]; };
layout(set = 0, binding = 2, std430) writeonly buffer Squared { float squared[]; };

void main() {
    ivec3 at = own_voxel();
    if (at.x >= now.width) return;
    int site = at.y * now.width + at.x;
    precise float z = float(now.first_slice + at.z) * now.side_z;
    precise float down = max(0.0f, z - heights[site]);
    precise float below = down * down - corrections[site];
    squared[at.z * now.height * now.width + site] = below;
}
