// The tiles of the picture that hold strands, six vertices each in one strip: the first and the last twice, so that nothing lies between tiles. Of the
// others nothing is left but a point.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "family.glsl"

layout(set = 0, binding = 10) readonly buffer Tiles { uint holds_strands[]; };

void main() {
    int tile = gl_VertexIndex / 6, corner = holds_strands[tile] == 0u ? 0 : clamp(gl_VertexIndex % 6 - 1, 0, 3);
    int across = tiles_across();
    vec2 pixel = vec2((ivec2(tile % across, tile / across) + ivec2(corner & 1, corner >> 1)) * tile_px);
    gl_Position = vec4(pixel / vec2(ivec2(coat.width_px, coat.height_px)) * 2.0f - 1.0f, 0.0f, 1.0f);
}
