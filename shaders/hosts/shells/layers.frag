// A uniform layer of fur: a texel of the fur map, found by a direction, tinted by the colour map and lit as a hair along the axis of the strands.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layers.glsl"
#include "fur/kajiya_kay.glsl"

layout(set = 0, binding = 1) uniform samplerCube fur_cube;
layout(set = 0, binding = 2) uniform samplerCube colour_cube;
layout(set = 0, binding = 3) uniform sampler2D fur_disc;
layout(set = 0, binding = 4) uniform sampler2D colour_disc;

layout(location = 0) in vec3 base;
layout(location = 1) in vec3 facing;
layout(location = 2) in vec3 from_eye;
layout(location = 3) in vec3 axis;  // of the strands here
layout(location = 0) out vec4 colour;

layout(constant_id = 0) const int lookup = lookup_cube;
layout(constant_id = 1) const int addressing = addressing_sum;
layout(constant_id = 2) const int filtered = 0;  // through the mip levels; the thesis reads the finest alone

void main() {
    vec3 normal = normalize(facing);
    vec3 way = normal;
    if (addressing == addressing_position) way = normalize(base);
    if (addressing == addressing_sum) way = normalize(normal + normalize(base));
    vec4 strand;
    vec3 tint;
    if (lookup == lookup_cube) {
        strand = filtered != 0 ? texture(fur_cube, way) : textureLod(fur_cube, way, 0.0f);
        tint = filtered != 0 ? texture(colour_cube, way).rgb : textureLod(colour_cube, way, 0.0f).rgb;
    } else {
        // On the disc that a mirroring ball shows from +z: half of the way from the viewer's direction (Algorithm 6).
        vec2 uv = 0.5f + vec2(way.x, -way.y) / (2.0f * length(way + vec3(0.0f, 0.0f, 1.0f)));
        strand = filtered != 0 ? texture(fur_disc, uv) : textureLod(fur_disc, uv, 0.0f);
        tint = filtered != 0 ? texture(colour_disc, uv).rgb : textureLod(colour_disc, uv, 0.0f).rgb;
    }
    KajiyaKay light = kajiya_kay(normalize(axis), vec3(fur.key_x, fur.key_y, fur.key_z), normalize(from_eye));
    colour = vec4(strand.rgb * tint * (fur.ambient + fur.diffuse * light.diffuse) + fur.specular * pow(light.specular, fur.power), strand.a);
}
