// The transform along one axis: out[i] = min over k of in[i + k] + (k side)^2, over as many k as can still matter.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "distance.glsl"

layout(set = 0, binding = 0, std430) readonly buffer Before { float before[]; };
layout(set = 0, binding = 1, std430) writeonly buffer After { float after_[]; };
layout(set = 0, binding = 2, std430) readonly buffer Away { float away[]; };    // (k side)^2, of u and then of v
layout(set = 0, binding = 3, std430) readonly buffer Least { float least[]; };  // of a slice: nothing in a row is less; then in any row

void main() {
    ivec3 at = own_voxel();
    if (at.x >= now.width) return;
    int own = (at.z * now.height + at.y) * now.width + at.x;
    bool along_u = now.axis == 0;
    int place = along_u ? at.x : at.y;
    int size = along_u ? now.width : now.height;
    int stride = along_u ? 1 : now.width;
    int line = own - place * stride;
    int far = along_u ? 0 : now.width / 2 + 1;
    float bound = least[(now.first_slice + at.z) * (now.height + 1) + (along_u ? at.y : now.height)];
    precise float best = before[own];
    int left = place, right = place;
    for (int k = 1; k <= size / 2; ++k) {  // farther ones have a nearer repeat
        precise float nothing_below = bound + away[far + k];
        if (nothing_below >= best) break;
        left = left > 0 ? left - 1 : size - 1;
        right = right < size - 1 ? right + 1 : 0;
        precise float nearer = min(before[line + left * stride], before[line + right * stride]) + away[far + k];
        best = min(best, nearer);
    }
    after_[own] = best;
}
