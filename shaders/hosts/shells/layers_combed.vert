// The mesh pushed out along strands that lean, once for each layer, at equal steps: the innermost first.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layers.glsl"
#include "fur/strand_shape.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 comb;
layout(location = 0) out vec3 base;
layout(location = 1) out vec3 facing;
layout(location = 2) out vec3 from_eye;
layout(location = 3) out vec3 axis;

void main() {
    float level = float(first_layer + gl_InstanceIndex) / float(fur.layers);
    base = position;
    facing = normal;
    StrandShape shape = strand_shape(normal, comb, level, fur.tilt, fur.bend);
    axis = shape.tangent;
    vec3 at = position + shape.offset * fur.fur_height;
    from_eye = at - vec3(fur.eye_x, fur.eye_y, fur.eye_z);
    gl_Position = to_clip * vec4(at, 1.0f);
}
