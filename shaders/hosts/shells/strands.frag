// A layer of fur: which strand passes under this pixel here, how much of the pixel it covers, and how it is lit.
// The mesh was pushed out along the strands, so that around a fragment they all run alike; what is left of each is its root, seen from
// the fragment's own place on the skin, and what sets it apart. A layer stands for the fur half way to its neighbours: distances are
// between the line of sight and that piece of the strand, so that strands hang together from layer to layer. How wide, how dark and how deep in the fur
// a strand is, is told by its own point next to the line of sight, and chance is the strand's: what a pixel shows hardly depends on where layers lie.
// Whatever stands in the loop is done for every root of the list: software devices run both sides of a branch, and take sines one by one.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "family.glsl"
#include "fur/line_coverage.glsl"
#include "fur/strand_light.glsl"

// The grid of roots (fur/strand_grid.h). Texel buffers, because software devices read those by vectors and storage buffers lane by lane.
layout(set = 0, binding = 1) uniform usamplerBuffer bricks;
layout(set = 0, binding = 2) uniform usamplerBuffer starts;
layout(set = 0, binding = 3) uniform usamplerBuffer lists;
layout(set = 0, binding = 4) uniform sampler3D lock_noise;   // three values in [-1,1], repeating
layout(set = 0, binding = 5) uniform sampler2D light_depth;  // z of to_light where the key light meets the fur

layout(location = 0) in vec3 base;
layout(location = 1) in vec3 facing;
layout(location = 2) in vec4 axis;
layout(location = 3) in vec3 at;
layout(location = 4) flat in vec2 slab;  // the layer's level, and half the height that it stands for
layout(location = 0) out vec4 colour;

layout(constant_id = 0) const uint curled = 0u;  // whether strands are helices

// sin(2 pi x) within 0.001, by parabolas (Capens 2006, "Fast and accurate sine/cosine").
float turn_sin(float x) {
    float t = x - floor(x + 0.5f);
    float y = t * (8.0f - 16.0f * abs(t));
    return y * (0.775f + 0.225f * abs(y));
}

vec3 decoded_normal(uint bits) {
    vec2 e = vec2(float(bits & 255u), float((bits >> 8) & 255u)) * (2.0f / 255.0f) - 1.0f;
    vec3 n = vec3(e, 1.0f - abs(e.x) - abs(e.y));
    float t = max(-n.z, 0.0f);
    n.x += n.x >= 0.0f ? -t : t;
    n.y += n.y >= 0.0f ? -t : t;
    return n;  // not of unit length: only its direction is asked for
}

uint mixed(uint h) {
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return h ^ (h >> 16);
}

void main() {
    if (axis.w < 0.02f) discard;
    float level = slab.x;
    vec3 normal = normalize(facing);
    float full = coat.fur_length * axis.w;
    vec3 eye = vec3(coat.eye_x, coat.eye_y, coat.eye_z);
    float far = length(eye - at);
    vec3 view = (eye - at) / far;
    float pixel = coat.pixel_angle * far;

    // Locks sway together. A strand grows where its lock has carried it from, found in one step.
    vec3 sway = 1.5f * texture(lock_noise, base * coat.lock_frequency).xyz;
    sway -= normal * dot(sway, normal);
    float swing = coat.lock * sqrt(level);
    vec3 place = base - sway * (swing * level * full);
    vec3 common_tangent = normalize(axis.xyz + sway * (1.5f * swing));

    vec3 side = normalize(abs(normal.y) < 0.9f ? cross(normal, vec3(0.0f, 1.0f, 0.0f)) : cross(normal, vec3(1.0f, 0.0f, 0.0f)));
    vec3 other = cross(normal, side);
    float half_piece = 1.1f * slab.y * full;

    vec3 in_cells = (place - vec3(coat.low_x, coat.low_y, coat.low_z)) * coat.cells_per_unit;
    ivec3 cell = ivec3(floor(in_cells)), size = ivec3(coat.bricks_x, coat.bricks_y, coat.bricks_z);
    ivec3 brick = clamp(cell >> 3, ivec3(0), size - 1);
    int list = int(texelFetch(bricks, brick.x + size.x * (brick.y + size.y * brick.z)).x) * 512 + ((cell.x & 7) | (cell.y & 7) << 3 | (cell.z & 7) << 6);
    int first = int(texelFetch(starts, list).x), last = int(texelFetch(starts, list + 1).x);
    float unit = 1.0f / coat.cells_per_unit;
    vec3 from_corner = (in_cells - vec3(cell) + 1.0f) * unit;
    // Partly covered pixels are decided by chance (Wyman and McGuire 2017, "Hashed Alpha Testing"): no order is needed. Each strand has a chance of
    // its own, by multiples of two irrationals, and the same in all layers, so that it is decided upon once.
    uvec2 p = uvec2(gl_FragCoord.xy);
    float noise = float(mixed(p.x * 0x9e3779b1u ^ p.y * 0x85ebca77u) >> 8) * (1.0f / 16777216.0f) + coat.sample_shift;
    const float nothing = -1e9f;
    float nearest = nothing, rise = 0.0f, share = 0.0f;  // toward the eye from `at`; of the strand's point over the layer
    uint chance = 0u;
    vec3 tangent = common_tangent;
    float reach2 = coat.reach * coat.reach, grown = min(4.0f * level, 1.0f) * coat.curl_radius;
    for (int i = first; i < last; ++i) {
        uvec2 root = texelFetch(lists, i).xy;
        vec3 e = from_corner - vec3(float(root.x & 1023u), float((root.x >> 10) & 1023u), float(root.x >> 20)) * (unit * 3.0f / 1023.0f);
        float off = dot(e, normal);
        e -= normal * off;
        bool near = dot(e, e) < reach2 && abs(off) < 2.0f * coat.reach + 2.0f * coat.off && dot(decoded_normal(root.y), normal) > 0.0f;
        float u = float((root.y >> 16) & 255u) * (1.0f / 255.0f), v = float(root.y >> 24) * (1.0f / 255.0f);
        bool guard = v < coat.guard_hairs;
        float tip = guard ? 1.0f : 1.0f - coat.length_variation * u;
        vec3 lean = (side * (fract(u * 7.0f) - 0.5f) + other * (fract(v * 11.0f) - 0.5f)) * (2.0f * coat.spread);
        e -= lean * (level * full);
        vec3 t = common_tangent + lean;
        if (curled != 0u) {
            float turn = v * 7.0f + coat.curl_turns * level;
            float s = turn_sin(turn), c = turn_sin(turn + 0.25f);
            e -= (side * c + other * s) * grown;
            t = normalize(t + (other * c - side * s) * (grown * 6.2831853f * coat.curl_turns / full));
        }
        // Nearest points of the line of sight and the piece of the strand.
        float c = dot(view, t), along_strand = dot(e, t), along_view = dot(e, view);
        float m = clamp((along_strand - c * along_view) / max(1.0f - c * c, 1e-3f), -half_piece, half_piece);
        float s = m * c - along_view;
        vec3 gap = e + view * s - t * m;
        float way = max(level + m / full, 0.0f) / tip;
        float way4 = way * way;
        way4 *= way4;
        float radius = coat.width * (guard ? 1.6f : 1.0f) * (1.0f - mix(way, way4, coat.taper));
        float cover = near && way < 1.0f ? line_coverage(length(gap), radius, pixel) : 0.0f;
        if (cover > fract(noise + u * 157.59f + v * 192.49f) && s > nearest) {
            nearest = s;
            chance = root.y >> 16;
            share = way;
            tangent = t;
            rise = m;
        }
    }
    if (nearest == nothing) discard;
    float u = float(chance & 255u) * (1.0f / 255.0f), v = float(chance >> 8) * (1.0f / 255.0f);
    vec3 albedo = mix(vec3(coat.root_r, coat.root_g, coat.root_b), vec3(coat.tip_r, coat.tip_g, coat.tip_b), sqrt(share));
    albedo *= 1.0f + coat.colour_variation * (2.0f * fract(u * 5.3f + v * 3.1f) - 1.0f);
    if (fract(v * 13.7f + u) < coat.grizzle) albedo = mix(albedo, vec3(0.75f), 0.7f);
    float below = clamp(-normal.y, 0.0f, 1.0f);
    albedo = mix(albedo, sqrt(albedo), coat.countershade * below);
    albedo *= 1.0f + 0.25f * sway.x;

    vec3 key = vec3(coat.key_x, coat.key_y, coat.key_z), rim_light = vec3(coat.rim_x, coat.rim_y, coat.rim_z);
    vec4 seen = to_light * vec4(at + view * nearest, 1.0f);
    float depth = max(seen.z - texture(light_depth, seen.xy).x, 0.0f) * 4.0f;
    float lit = exp(-coat.extinction * depth);
    float occlusion = mix(0.18f, 1.0f, level + rise / full);
    vec3 ambient = mix(vec3(0.30f, 0.27f, 0.25f), vec3(0.62f, 0.70f, 0.82f), 0.5f + 0.5f * normal.y) * 0.55f;
    vec3 shown = albedo * ambient * occlusion;
    shown += vec3(2.0f, 1.88f, 1.7f) * lit * strand_light(albedo, tangent, normal, view, key, coat.gloss);
    // From behind: mostly what passes through the edge of the fur.
    float behind = pow(max(1.0f - abs(dot(normal, view)), 0.0f), 2.0f) * max(dot(normal, rim_light) + 0.3f, 0.0f);
    shown += vec3(0.9f, 1.0f, 1.15f) * behind * occlusion * (albedo + 0.1f * coat.gloss);
    colour = vec4(shown, 1.0f);
}
