// What is stored of a squared distance, as half floats, two a word. The values that may be stored are numbered upward: 0 is 0, and 1 and
// -1 are the least normal numbers. From which squared distance on each is stored is a table of the CPU's, so that the device's root and
// quotient, which may be rounded as it likes, only say where to look first.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "distance.glsl"

layout(set = 0, binding = 0, std430) readonly buffer Squared { float squared[]; };
layout(set = 0, binding = 1, std430) readonly buffer From { float from[]; };  // rising, the last one beyond everything
layout(set = 0, binding = 2, std430) writeonly buffer Halves { uint halves[]; };

const int least_normal = 0x38800000 >> 13;  // 2^-14, in steps of a half float

uint stored(float s) {
    float value = s >= 2.0f * now.quarter ? sqrt(s - now.quarter) : (s - now.quarter) / now.half_diagonal;
    float low = value - now.slack;
    int steps = int((floatBitsToUint(low) & 0x7fffffffu) >> 13) - least_normal + 1;
    int number = abs(low) < 6.103515625e-5f ? 0 : low < 0.0f ? -steps - 1 : steps;
    int entry = clamp(number - now.lowest_value, 0, now.values - 1);
    while (entry > 0 && s < from[entry]) --entry;
    while (s >= from[entry + 1]) ++entry;
    number = entry + now.lowest_value;
    if (number == 0) return 0u;
    return number > 0 ? uint(number) + 0x3ffu : uint(-number) + 0x83ffu;
}

void main() {
    uint word = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    uint count = uint(now.slices * now.height * now.width);
    uint first = 2u * word;
    if (first >= count) return;
    uint low = stored(squared[first]);
    halves[word] = first + 1u < count ? low | stored(squared[first + 1u]) << 16 : low;
}
