// Points along every strand, from its root to its tip: the formulas of docs/concepts/fur.md, a strand to an invocation.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "family.glsl"
#include "fur/strand_shape.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 0) const uint curled = 0u;  // whether strands are helices: software devices take sines one by one
layout(constant_id = 1) const uint pushed = 0u;  // whether forces bend them
layout(set = 0, binding = 1) uniform usamplerBuffer places;   // x, y, z, comb
layout(set = 0, binding = 2) uniform usamplerBuffer natures;  // normal; length and chance
layout(set = 0, binding = 9) uniform samplerBuffer pushes;  // fur/fur_motion.h
layout(set = 0, binding = 8) writeonly buffer Points { vec4 points[]; };
layout(set = 0, binding = 5) uniform sampler3D lock_noise;  // three values in [-1,1], repeating

void main() {
    uint strand = gl_GlobalInvocationID.x;
    if (strand >= uint(coat.strands)) return;
    uvec4 place_bits = texelFetch(places, int(strand));
    uvec2 nature = texelFetch(natures, int(strand)).xy;
    vec3 root = uintBitsToFloat(place_bits.xyz), normal = unpacked_normal(nature.x);
    vec3 comb = vec3(float(place_bits.w & 1023u), float((place_bits.w >> 10) & 1023u), float((place_bits.w >> 20) & 1023u)) * (2.0f / 1023.0f) - 1.0f;
    comb -= normal * dot(comb, normal);
    vec2 chance = chance_of(nature.y);
    float tip = is_guard(chance) ? 1.0f : 1.0f - coat.length_variation * chance.x;
    float full = coat.fur_length * length_share(nature.y);
    vec3 side = normalize(abs(normal.y) < 0.9f ? cross(normal, vec3(0.0f, 1.0f, 0.0f)) : cross(normal, vec3(1.0f, 0.0f, 0.0f)));
    vec3 other = cross(normal, side);
    vec3 lean = (side * (fract(chance.x * 7.0f) - 0.5f) + other * (fract(chance.y * 11.0f) - 0.5f)) * (2.0f * coat.spread);

    vec3 push = vec3(0.0f);
    if (pushed != 0u) {
        push = texelFetch(pushes, int(strand)).xyz;
        push -= normal * dot(push, normal);
    }
    vec3 sway = vec3(0.0f), place = root;
    for (int k = 0; k <= coat.pieces; ++k) {
        float level = tip * float(k) / float(coat.pieces);
        // The place on the skin whose lock has carried the root here: place = root + sway(place), from where the level below found it.
        float swing = coat.lock * level * sqrt(level) * full;
        sway = 1.5f * texture(lock_noise, place * coat.lock_frequency).xyz;
        sway -= normal * dot(sway, normal);
        place = root + sway * swing;
        StrandShape shape;
        if (pushed != 0u) shape = pushed_shape(normal, comb, push, level, coat.tilt, coat.bend);
        else shape = strand_shape(normal, comb, level, coat.tilt, coat.bend);
        vec3 at = place + shape.offset * full + lean * (level * full);
        if (curled != 0u) {
            float turn = 6.2831853f * (7.0f * chance.y + coat.curl_turns * level);
            at += (side * cos(turn) + other * sin(turn)) * (coat.curl_radius * min(4.0f * level, 1.0f));
        }
        points[point_index(strand, k)] = vec4(at, sway.x);
    }
}
