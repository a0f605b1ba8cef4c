// The colour of the strand that each pixel shows, computed once. Pixels that show skin keep what is there.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "family.glsl"
#include "fur/strand_light.glsl"

layout(set = 0, binding = 2) uniform usamplerBuffer natures;
layout(set = 0, binding = 3) uniform samplerBuffer points;
layout(set = 0, binding = 4) readonly buffer Seen { uvec2 seen[]; };  // strand and level, depth
layout(set = 0, binding = 6) uniform sampler2D light_depth;  // z of to_light where the key light meets the fur
layout(set = 0, binding = 7) uniform sampler2D skin_depth;

layout(location = 0) out vec4 colour;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uvec2 found = seen[pixel.y * coat.width_px + pixel.x];
    if (found.y >= floatBitsToUint(texelFetch(skin_depth, pixel, 0).x)) discard;
    uint strand = found.x >> 8;
    float way = (float(found.x & 255u) + 0.5f) * (1.0f / 256.0f);
    uvec2 nature = texelFetch(natures, int(strand)).xy;
    float along = way * float(coat.pieces);
    int piece = min(int(along), coat.pieces - 1);
    vec4 from = texelFetch(points, point_index(strand, piece)), to = texelFetch(points, point_index(strand, piece + 1));
    vec3 at = mix(from.xyz, to.xyz, along - float(piece)), tangent = normalize(to.xyz - from.xyz), normal = unpacked_normal(nature.x);
    vec3 eye = vec3(coat.eye_x, coat.eye_y, coat.eye_z), view = normalize(eye - at);
    vec2 chance = chance_of(nature.y);
    float level = way * (is_guard(chance) ? 1.0f : 1.0f - coat.length_variation * chance.x);

    vec3 albedo = mix(vec3(coat.root_r, coat.root_g, coat.root_b), vec3(coat.tip_r, coat.tip_g, coat.tip_b), sqrt(way));
    albedo *= 1.0f + coat.colour_variation * (2.0f * fract(chance.x * 5.3f + chance.y * 3.1f) - 1.0f);
    if (fract(chance.y * 13.7f + chance.x) < coat.grizzle) albedo = mix(albedo, vec3(0.75f), 0.7f);
    float below = clamp(-normal.y, 0.0f, 1.0f);
    albedo = mix(albedo, sqrt(albedo), coat.countershade * below);
    albedo *= 1.0f + 0.25f * to.w;

    vec3 key = vec3(coat.key_x, coat.key_y, coat.key_z), rim_light = vec3(coat.rim_x, coat.rim_y, coat.rim_z);
    vec4 lit_at = to_light * vec4(at, 1.0f);
    float depth = max(lit_at.z - texture(light_depth, lit_at.xy).x, 0.0f) * 4.0f;
    float lit = exp(-coat.extinction * depth);
    float occlusion = mix(0.18f, 1.0f, level);
    vec3 ambient = mix(vec3(0.30f, 0.27f, 0.25f), vec3(0.62f, 0.70f, 0.82f), 0.5f + 0.5f * normal.y) * 0.55f;
    vec3 shown = albedo * ambient * occlusion;
    shown += vec3(2.0f, 1.88f, 1.7f) * lit * strand_light(albedo, tangent, normal, view, key, coat.gloss);
    // From behind: mostly what passes through the edge of the fur.
    float behind = pow(max(1.0f - abs(dot(normal, view)), 0.0f), 2.0f) * max(dot(normal, rim_light) + 0.3f, 0.0f);
    shown += vec3(0.9f, 1.0f, 1.15f) * behind * occlusion * (albedo + 0.1f * coat.gloss);
    colour = vec4(shown, 1.0f);
}
