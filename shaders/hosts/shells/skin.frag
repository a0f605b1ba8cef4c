// Skin: seen where strands leave a gap, in their shade; bare where none grow.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "family.glsl"
#include "fur/skin_light.glsl"

layout(location = 0) in vec3 at;
layout(location = 1) in vec3 facing;
layout(location = 2) in float furred;
layout(location = 0) out vec4 colour;

void main() {
    vec3 n = normalize(facing);
    vec3 key = vec3(coat.key_x, coat.key_y, coat.key_z);
    float covered = clamp(furred * 4.0f, 0.0f, 1.0f);
    vec3 albedo = mix(vec3(0.55f, 0.42f, 0.36f), vec3(coat.root_r, coat.root_g, coat.root_b), covered);
    colour = vec4(skin_light(albedo, n, key, covered), 1.0f);
}
