// A level sheet over the whole base, at a height of the relief.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "draw.glsl"
#include "projection.glsl"

void main() {
    vec2 corner = vec2(float(gl_VertexIndex & 1), float(gl_VertexIndex >> 1));
    gl_Position = projected(vec3((corner - vec2(0.5f)) * scene.periods, (numbers.sheet_level - relief.zero_level) * relief.height_scale));
}
