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
    // strand_shape by half angles: offset = level sinc(h) (cos(start + h) normal + sin(start + h) along), where h = turn level / 2 grows by the same
    // step from point to point. Software devices take sines one by one: one turn by that step, applied again and again, does without them.
    float combed = min(length(comb), 1.0f), start = coat.tilt * combed, half_step = 0.5f * coat.bend * combed * tip / float(coat.pieces);
    vec3 along = combed > 1e-4f ? comb / length(comb) : vec3(0.0f);
    vec3 ahead = normal * cos(start) + along * sin(start), aside = along * cos(start) - normal * sin(start);
    float step_cos = cos(half_step), step_sin = sin(half_step), half_cos = 1.0f, half_sin = 0.0f;

    points[point_index(strand, 0)] = vec4(root, 0.0f);
    vec3 place = root;
    for (int k = 1; k <= coat.pieces; ++k) {
        float level = tip * float(k) / float(coat.pieces);
        // The place on the skin whose lock has carried the root here: place = root + sway(place), from where the level below found it.
        float swing = coat.lock * level * sqrt(level) * full;
        vec3 sway = 1.5f * texture(lock_noise, place * coat.lock_frequency).xyz;
        sway -= normal * dot(sway, normal);
        place = root + sway * swing;
        vec3 offset;
        if (pushed != 0u) offset = pushed_shape(normal, comb, push, level, coat.tilt, coat.bend).offset;
        else {
            float turned = half_cos * step_cos - half_sin * step_sin;
            half_sin = half_sin * step_cos + half_cos * step_sin;
            half_cos = turned;
            float h = max(half_step * float(k), 1e-6f);
            offset = (ahead * half_cos + aside * half_sin) * (level * (half_step > 1e-6f ? half_sin / h : 1.0f));
        }
        vec3 at = place + offset * full + lean * (level * full);
        if (curled != 0u) {
            float turn = 6.2831853f * (7.0f * chance.y + coat.curl_turns * level);
            at += (side * cos(turn) + other * sin(turn)) * (coat.curl_radius * min(4.0f * level, 1.0f));
        }
        points[point_index(strand, k)] = vec4(at, sway.x);
    }
}
