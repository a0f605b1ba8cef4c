// A mesh as it lies in its vertex buffer: position and normal, nothing moved.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "phong.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec3 at;
layout(location = 1) out vec3 facing;

void main() {
    at = position;
    facing = normal;
    gl_Position = to_clip * vec4(position, 1.0f);
}
