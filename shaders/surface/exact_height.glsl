// The declared surface without the texture unit's blending, whose weights have 8 bits.
#ifndef RELIEVO_SURFACE_EXACT_HEIGHT
#define RELIEVO_SURFACE_EXACT_HEIGHT

#include "maps.glsl"

// Height at a texture coordinate, to float rounding. One fetch.
float exact_height(vec2 uv) {
    ivec2 size = height_size();
    vec2 at = vec2(uv.x * float(size.x) - 0.5f, uv.y * float(size.y) - 0.5f);
    vec2 cell = vec2(floor(at.x), floor(at.y));
    vec4 c = height_cell(vec2((cell.x + 1.0f) / float(size.x), (cell.y + 1.0f) / float(size.y)));
    return mix(mix(c.x, c.y, at.x - cell.x), mix(c.z, c.w, at.x - cell.x), at.y - cell.y);
}

#endif
