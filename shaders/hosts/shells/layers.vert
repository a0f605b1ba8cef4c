// The mesh pushed out along its normals, once for each layer, at equal steps: the innermost first.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "layers.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec3 base;
layout(location = 1) out vec3 facing;
layout(location = 2) out vec3 from_eye;
layout(location = 3) out vec3 axis;

void main() {
    float level = float(first_layer + gl_InstanceIndex) / float(fur.layers);
    base = position;
    facing = axis = normal;
    vec3 at = position + normal * (fur.fur_height * level);
    from_eye = at - vec3(fur.eye_x, fur.eye_y, fur.eye_z);
    gl_Position = to_clip * vec4(at, 1.0f);
}
