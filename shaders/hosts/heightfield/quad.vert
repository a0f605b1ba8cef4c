// The square base in the plane z = 0, centred on the origin, as a strip of four vertices: u along +x, v along +y.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

layout(location = 0) out vec2 base_uv;
layout(location = 1) out vec3 base_position;

void main() {
    vec2 corner = vec2(float(gl_VertexIndex & 1), float(gl_VertexIndex >> 1));
    base_uv = corner * scene.periods;
    base_position = vec3((corner - vec2(0.5f)) * scene.periods, 0.0f);
    vec3 from_eye = base_position - vec3(scene.eye_x, scene.eye_y, scene.eye_z);
    float w = -dot(from_eye, vec3(scene.back_x, scene.back_y, scene.back_z));
    // Clip space has y down the screen, and depth only clips here: everything nearer than near_z.
    gl_Position = vec4(dot(from_eye, vec3(scene.right_x, scene.right_y, scene.right_z)) * scene.scale_x + scene.shift_x * w,
                       scene.shift_y * w - dot(from_eye, vec3(scene.up_x, scene.up_y, scene.up_z)) * scene.scale_y,
                       w - scene.near_z, w);
}
