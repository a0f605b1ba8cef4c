// The mesh pushed out along its strands, once for each layer; the outermost first, so that it hides what it covers.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "family.glsl"
#include "fur/layer_top.glsl"
#include "fur/strand_shape.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 comb;  // w: length here, as a share of the coat's
layout(location = 3) in vec3 push;
layout(location = 0) out vec3 base;
layout(location = 1) out vec3 facing;
layout(location = 2) out vec4 axis;  // tangent of the strands at this height; w: length here
layout(location = 3) out vec3 at;
layout(location = 4) flat out vec2 slab;  // the layer's level, and half the height that it stands for

void main() {
    float high = layer_top(gl_InstanceIndex, coat.layers), low = layer_top(gl_InstanceIndex + 1, coat.layers);
    float level = 0.5f * (low + high);
    slab = vec2(level, 0.5f * (high - low));
    base = position;
    facing = normal;
    StrandShape shape = pushed_shape(normal, comb.xyz, push, level, coat.tilt, coat.bend);
    axis = vec4(shape.tangent, comb.w);
    at = position + shape.offset * (coat.fur_length * comb.w);
    gl_Position = to_clip * vec4(at, 1.0f);
}
