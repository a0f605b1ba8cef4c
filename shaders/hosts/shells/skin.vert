// The mesh itself, under its fur.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "family.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 comb;
layout(location = 0) out vec3 at;
layout(location = 1) out vec3 facing;
layout(location = 2) out float furred;

void main() {
    at = position;
    facing = normal;
    furred = comb.w;
    gl_Position = to_clip * vec4(position, 1.0f);
}
