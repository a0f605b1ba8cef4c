// A layer of a patch: a texel of its square of strands, lit as a hair along the strands there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layers.glsl"
#include "fur/kajiya_kay.glsl"

layout(set = 0, binding = 3) uniform sampler2D strands;
layout(set = 0, binding = 4) uniform sampler2D colours;

layout(location = 0) in vec2 texel;
layout(location = 2) in vec3 from_eye;
layout(location = 3) in vec3 axis;
layout(location = 0) out vec4 colour;

void main() {
    vec4 strand = texture(strands, texel);
    vec3 tint = texture(colours, texel).rgb;
    KajiyaKay light = kajiya_kay(normalize(axis), vec3(fur.key_x, fur.key_y, fur.key_z), normalize(from_eye));
    colour = vec4(strand.rgb * tint * (fur.ambient + fur.diffuse * light.diffuse) + fur.specular * pow(light.specular, fur.power), strand.a);
}
