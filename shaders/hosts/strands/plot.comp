// Strands into the picture: each pixel keeps the nearest by an atomic minimum of depth and strand, so that no order is needed.
// A strand is as many straight pieces as it has layers, and each piece is walked pixel by pixel along the axis on which it is longer.
// What is thinner than `coat.thinnest` pixels is drawn that thick and ends the sooner: a share of the strands that is what their width lacks. Which
// ones depends on the strand and nothing else, so that a moving picture does not flicker, and seen from afar fewer strands are drawn.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#extension GL_EXT_shader_atomic_int64 : require
#include "family.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 2) uniform usamplerBuffer natures;
layout(set = 0, binding = 3) uniform samplerBuffer points;
layout(set = 0, binding = 4) buffer Seen { uint64_t seen[]; };
layout(set = 0, binding = 7) uniform sampler2D skin_depth;
layout(set = 0, binding = 10) writeonly buffer Tiles { uint holds_strands[]; };

vec4 projected(uint strand, int level) {
    vec4 p = to_clip * vec4(texelFetch(points, point_index(strand, level)).xyz, 1.0f);
    float inverse = 1.0f / p.w;
    // Pixels, 0 at the middle of the first.
    return vec4((p.x * inverse * 0.5f + 0.5f) * float(coat.width_px) - 0.5f, (p.y * inverse * 0.5f + 0.5f) * float(coat.height_px) - 0.5f, p.z * inverse, p.w);
}

// Whether skin hides a point, or the picture ends before it.
bool hidden(vec4 p) {
    ivec2 at = ivec2(round(p.xy));
    if (p.w < 1e-3f || at.x < 0 || at.y < 0 || at.x >= coat.width_px || at.y >= coat.height_px) return true;
    return p.z > texelFetch(skin_depth, at, 0).x;
}

void main() {
    // Software devices give each thread one unbroken run of groups. Strands follow the skin, so that one run would be the near side and another
    // the far one, with nothing to draw: groups are dealt out in turns of 64, those beyond the last whole turn as they come.
    uint turns = gl_NumWorkGroups.x / 64u, dealt = gl_WorkGroupID.x;
    if (dealt < turns * 64u) dealt = dealt % turns * 64u + dealt / turns;
    uint strand = dealt * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (strand >= uint(coat.strands)) return;
    // Strands of the far side, more than half of all, are given up at three of their points.
    if (hidden(projected(strand, coat.pieces)) && hidden(projected(strand, (2 * coat.pieces + 1) / 3)) && hidden(projected(strand, (coat.pieces + 1) / 3))) return;
    bool guard = is_guard(chance_of(texelFetch(natures, int(strand)).y));
    float radius = coat.width * (guard ? 1.6f : 1.0f);
    // Neighbours in the list are neighbours on the skin: multiples of the golden ratio spread evenly over them.
    float keep = fract(float(strand) * 0.61803399f + coat.sample_shift);
    float thinnest = 0.5f * coat.thinnest;

    vec4 from = projected(strand, 0);
    float from_radius = radius / (coat.pixel_angle * from.w);
    bool open = from.w > 1e-3f && from_radius > keep * thinnest;
    vec2 least = vec2(1e9f), most = vec2(-1e9f);  // pixels, of what is plotted
    for (int k = 1; k <= coat.pieces && open; ++k) {
        float way = float(k) / float(coat.pieces), way4 = way * way;
        way4 *= way4;
        vec4 to = projected(strand, k);
        float to_radius = radius * (1.0f - mix(way, way4, coat.taper)) / (coat.pixel_angle * to.w);
        open = to.w > 1e-3f;
        if (!open) break;
        vec2 d = to.xy - from.xy;
        bool flat_ = abs(d.x) >= abs(d.y);
        float a0 = flat_ ? from.x : from.y, b0 = flat_ ? from.y : from.x;
        float a = flat_ ? d.x : d.y, b = flat_ ? d.y : d.x;
        float inverse = 1.0f / (abs(a) < 1e-6f ? 1e-6f : a);
        float slope = b * inverse, stretch = sqrt(1.0f + slope * slope);
        // The part of the piece that is thick enough.
        float end = to_radius >= keep * thinnest ? 1.0f : (from_radius - keep * thinnest) / max(from_radius - to_radius, 1e-9f);
        float a1 = a0 + a * end;
        int size = flat_ ? coat.width_px : coat.height_px, other_size = flat_ ? coat.height_px : coat.width_px;
        int first = max(int(ceil(min(a0, a1))), 0), last = min(int(ceil(max(a0, a1))), size);
        int step_a = flat_ ? 1 : coat.width_px, step_b = flat_ ? coat.width_px : 1;
        float beside = 1.4143f * max(max(from_radius, to_radius), thinnest);
        least = min(least, min(from.xy, to.xy) - beside);
        most = max(most, max(from.xy, to.xy) + beside);
        // One loop over the pixels of all rows, because software devices go through it as often as the longest of eight strands asks for.
        uint64_t key = 0ul;
        int j = 0, high = 0;
        for (int i = first; i < last;) {
            if (j >= high) {
                float t = (float(i) - a0) * inverse, middle = b0 + slope * (float(i) - a0);
                float reach = max(mix(from_radius, to_radius, t), thinnest) * stretch;
                uint level = uint((float(k - 1) + clamp(t, 0.0f, 1.0f)) / float(coat.pieces) * 255.0f);
                key = (uint64_t(floatBitsToUint(mix(from.z, to.z, t))) << 32) | uint64_t(strand << 8 | level);
                j = max(int(ceil(middle - reach)), 0);
                high = min(int(ceil(middle + reach)), other_size);
            }
            if (j < high) atomicMin(seen[i * step_a + j * step_b], key);
            ++j;
            if (j >= high) ++i;
        }
        open = end >= 1.0f;
        from = to;
        from_radius = to_radius;
    }
    ivec2 size = ivec2(coat.width_px, coat.height_px) - 1;
    ivec2 low = ivec2(clamp(least, vec2(0.0f), vec2(size))) / tile_px, high = ivec2(clamp(most, vec2(0.0f), vec2(size))) / tile_px;
    if (most.x < least.x) return;
    ivec2 at = low;
    while (at.y <= high.y) {
        holds_strands[at.y * tiles_across() + at.x] = 1u;
        bool wraps = at.x == high.x;
        at = wraps ? ivec2(low.x, at.y + 1) : ivec2(at.x + 1, at.y);
    }
}
