// The outside of the fur as the light sees it; only depth is written.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "family.glsl"
#include "fur/strand_shape.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 comb;
layout(location = 3) in vec3 push;

void main() {
    // Few strands reach the full length: light first meets fur somewhat below.
    vec3 at = position + pushed_shape(normal, comb.xyz, push, 0.85f, coat.tilt, coat.bend).offset * (coat.fur_length * comb.w);
    gl_Position = to_clip * vec4(at, 1.0f);
}
