// The square base in the plane z = 0, centred on the origin, as a strip of four vertices: u along +x, v along +y.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "projection.glsl"

layout(location = 0) out vec2 base_uv;
layout(location = 1) out vec3 base_position;

void main() {
    vec2 corner = vec2(float(gl_VertexIndex & 1), float(gl_VertexIndex >> 1));
    base_uv = corner * scene.periods;
    base_position = vec3((corner - vec2(0.5f)) * scene.periods, 0.0f);
    gl_Position = projected(base_position);
}
