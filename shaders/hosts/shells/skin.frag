// Skin: seen where strands leave a gap, in their shade; bare where none grow.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "family.glsl"

layout(location = 0) in vec3 at;
layout(location = 1) in vec3 facing;
layout(location = 2) in float furred;
layout(location = 0) out vec4 colour;

void main() {
    vec3 n = normalize(facing);
    vec3 key = vec3(coat.key_x, coat.key_y, coat.key_z);
    vec3 albedo = mix(vec3(0.55f, 0.42f, 0.36f), vec3(coat.root_r, coat.root_g, coat.root_b), clamp(furred * 4.0f, 0.0f, 1.0f));
    float shade = mix(1.0f, 0.22f, clamp(furred * 4.0f, 0.0f, 1.0f));
    vec3 lit = albedo * shade * (0.3f + 0.2f * n.y + 1.6f * max(dot(n, key), 0.0f));
    colour = vec4(lit, 1.0f);
}
