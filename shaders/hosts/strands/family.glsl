// What all programs that plot strands share: the coat, the cameras, the strands and the picture that they are plotted into.
#include "shared/coat.h"

layout(set = 0, binding = 0) uniform Coat { CoatUniforms coat; };
layout(push_constant) uniform Push {
    mat4 to_clip;   // from fur space, of the eye or of the light
    mat4 to_light;  // from fur space to the light's picture: x and y in [0,1], z the distance from its plane
};

// Strands are read through texel buffers: software devices read those by vectors, and storage buffers lane by lane.
vec3 unpacked_normal(uint bits) {
    vec2 e = unpackSnorm2x16(bits);
    vec3 n = vec3(e, 1.0f - abs(e.x) - abs(e.y));
    float t = max(-n.z, 0.0f);
    n.x += n.x >= 0.0f ? -t : t;
    n.y += n.y >= 0.0f ? -t : t;
    return normalize(n);
}

// Of fur/rooted_strands.h's second word of a nature.
float length_share(uint bits) { return float(bits >> 16) * (1.0f / 65535.0f); }
vec2 chance_of(uint bits) { return vec2(float(bits & 255u), float((bits >> 8) & 255u)) * (1.0f / 255.0f); }
bool is_guard(vec2 chance) { return chance.y < coat.guard_hairs; }

// Points of all strands, level by level: `coat.pieces` + 1 levels of `coat.strands` points; the fourth number is the sway of the lock there.
int point_index(uint strand, int level) { return level * coat.strands + int(strand); }

// Tiles of the picture, row by row.
int tiles_across() { return (coat.width_px + tile_px - 1) / tile_px; }
