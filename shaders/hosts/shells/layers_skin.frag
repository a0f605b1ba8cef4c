// The mesh under uniform layers.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layers.glsl"
#include "fur/skin_light.glsl"

layout(location = 1) in vec3 facing;
layout(location = 0) out vec4 colour;

void main() {
    colour = vec4(skin_light(vec3(fur.skin_r, fur.skin_g, fur.skin_b), normalize(facing), vec3(fur.key_x, fur.key_y, fur.key_z), 1.0f), 1.0f);
}
