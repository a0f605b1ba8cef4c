// The maps' bindings and their accessors (surface/maps.glsl). Levels are always explicit: a derivative inside a search would be
// undefined, and heights are the declared surface only at their finest level. A missing map is bound as one texel.
#include "../../surface/maps.glsl"

layout(set = 0, binding = 0) uniform sampler2D height_map;   // bilinear, one level
layout(set = 0, binding = 1) uniform sampler2D normal_map;   // trilinear
layout(set = 0, binding = 2) uniform sampler2D colour_map;   // trilinear, decoded from sRGB
layout(set = 0, binding = 3) uniform sampler2D pyramid_map;  // nearest
layout(set = 0, binding = 4) uniform sampler2D cone_map;     // bilinear, one level
layout(set = 0, binding = 5) uniform sampler2D conservative_cone_map;  // bilinear, one level
layout(set = 0, binding = 6) uniform sampler2D relaxed_cone_map;       // bilinear, one level
layout(set = 0, binding = 7) uniform sampler2D robust_cone_map;        // nearest, one level
layout(set = 0, binding = 8) uniform sampler2DArray horizon_map;  // bilinear, a layer for each direction
layout(set = 0, binding = 9) uniform sampler3D distance_map;           // trilinear, one level
layout(set = 0, binding = 10) uniform sampler2DArray cell_cone_map;  // nearest, a layer for each quadrant

// Fetches of the search so far. The shade host never reads it, and the compiler drops it there.
int fetch_count = 0;

ivec2 height_size() { return textureSize(height_map, 0); }

float height_at(vec2 uv) {
    ++fetch_count;
    return textureLod(height_map, uv, 0.0f).x;
}

vec4 height_cell(vec2 middle) {
    ++fetch_count;
    // Half a texel from any other choice of four; wrapped first, so that the hardware's own digits are enough. A gather starts at the
    // upper left: (0,1), (1,1), (1,0), (0,0).
    vec4 g = textureGather(height_map, middle - floor(middle), 0);
    return vec4(g.w, g.z, g.x, g.y);
}

vec3 normal_at(vec2 uv, float lod) {
    ++fetch_count;
    ivec2 size = textureSize(normal_map, 0);
    return normalize(textureLod(normal_map, uv, lod + log2(float(max(size.x, size.y)))).xyz);
}

vec2 cone_at(vec2 uv) {
    ++fetch_count;
    return textureLod(cone_map, uv, 0.0f).xy;
}

vec2 conservative_cone_at(vec2 uv) {
    ++fetch_count;
    return textureLod(conservative_cone_map, uv, 0.0f).xy;
}

vec2 relaxed_cone_at(vec2 uv) {
    ++fetch_count;
    return textureLod(relaxed_cone_map, uv, 0.0f).xy;
}

// The texel inside the period; in GLSL the remainder of a negative number is undefined.
ivec2 wrapped_texel(ivec2 texel, ivec2 size) {
    vec2 periods = floor(vec2(texel) / vec2(size));
    ivec2 rest = texel - ivec2(periods) * size;
    // The quotient of a multiple of the size may be rounded to either side of a whole number.
    return ivec2(rest.x < 0 ? rest.x + size.x : (rest.x >= size.x ? rest.x - size.x : rest.x),
                 rest.y < 0 ? rest.y + size.y : (rest.y >= size.y ? rest.y - size.y : rest.y));
}

vec2 conservative_cone(ivec2 texel) {
    ++fetch_count;
    return texelFetch(conservative_cone_map, wrapped_texel(texel, textureSize(conservative_cone_map, 0)), 0).xy;
}

vec2 relaxed_cone(ivec2 texel) {
    ++fetch_count;
    return texelFetch(relaxed_cone_map, wrapped_texel(texel, textureSize(relaxed_cone_map, 0)), 0).xy;
}

vec2 robust_cone(ivec2 texel) {
    ++fetch_count;
    return texelFetch(robust_cone_map, wrapped_texel(texel, textureSize(robust_cone_map, 0)), 0).xy;
}

float horizon_at(vec2 uv, int direction) {
    ++fetch_count;
    return textureLod(horizon_map, vec3(uv, float(direction)), 0.0f).x;
}

float distance_at(vec3 uvz) {
    ++fetch_count;
    // The outer slices lie in the planes z = 0 and z = 1, not half a slice inside.
    float slices = float(textureSize(distance_map, 0).z);
    return textureLod(distance_map, vec3(uvz.x, uvz.y, (clamp(uvz.z, 0.0f, 1.0f) * (slices - 1.0f) + 0.5f) / slices), 0.0f).x;
}

int max_levels() { return textureQueryLevels(pyramid_map); }

float max_at(ivec2 node, int level) {
    ++fetch_count;
    return texelFetch(pyramid_map, node, level).x;
}

vec4 cell_cone(vec2 corner, int quadrant) {
    ++fetch_count;
    return textureLod(cell_cone_map, vec3(corner, float(quadrant)), 0.0f);
}

// Linear albedo; not for searches, so it is not counted.
vec3 colour_at(vec2 uv, float lod) {
    ivec2 size = textureSize(colour_map, 0);
    return textureLod(colour_map, uv, lod + log2(float(max(size.x, size.y)))).xyz;
}
