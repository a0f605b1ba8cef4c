// The camera's projection: clip space has y down the screen, and depth clips what is nearer than near_z.
#include "scene.glsl"

vec4 projected(vec3 position) {
    vec3 from_eye = position - vec3(scene.eye_x, scene.eye_y, scene.eye_z);
    float w = -dot(from_eye, vec3(scene.back_x, scene.back_y, scene.back_z));
    return vec4(dot(from_eye, vec3(scene.right_x, scene.right_y, scene.right_z)) * scene.scale_x + scene.shift_x * w,
                scene.shift_y * w - dot(from_eye, vec3(scene.up_x, scene.up_y, scene.up_z)) * scene.scale_y, w - scene.near_z, w);
}
