// Slices of the distance map, some at a time: squared distances, one float a voxel. Only sums, products, maxima and minima, each rounded
// by itself, so that they are those of the CPU.
#include "../../shared/distance_bake.h"

layout(local_size_x = 64) in;
layout(push_constant) uniform Step { DistanceStep now; };

// Voxel (x, y) of this dispatch's slice; x may lie behind the row's end, and then there is nothing to do.
ivec3 own_voxel() { return ivec3(int(gl_GlobalInvocationID.x), int(gl_WorkGroupID.y), int(gl_WorkGroupID.z)); }
