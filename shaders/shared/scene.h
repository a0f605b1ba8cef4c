// Camera, base, lights and draw settings as the hosts receive them. Scalars only, so that GLSL's and C++'s layouts are the same;
// C++ asserts it (render/scene_binding.h).
#ifndef RELIEVO_SHARED_SCENE_H
#define RELIEVO_SHARED_SCENE_H

// World space, right-handed, z up; a uniform buffer.
struct SceneUniforms {
    float eye_x, eye_y, eye_z;
    float right_x, right_y, right_z;  // unit axes of the camera: right and up on the screen, back from target to eye
    float up_x, up_y, up_z;
    float back_x, back_y, back_z;
    float scale_x, scale_y;  // 1 / tan of half the field of view, across and up
    float shift_x, shift_y;  // of the whole picture, in clip space: moves the sample inside its pixel
    float near_z;            // distance of the near plane
    float periods;           // edge of the square base in repeats; UV runs from 0 to periods, one world unit is one repeat
    float ambient_r, ambient_g, ambient_b;
    float specular;
    float shininess;
    float background_r, background_g, background_b;
    float padding_a, padding_b;  // uniform buffers are sized in steps of 16 bytes
};

// Lights that travel in the uniform buffer. Further ones come from a storage buffer, whose size has no limit but which the software
// device reads lane by lane: with two lights there, shading a textured quad took 67 ms of CPU time, here 30.
const int first_lights_count = 8;

// core/lighting.h's Light.
struct LightUniforms {
    float x, y, z;  // position, or the unit direction toward a directional light
    int directional;
    float r, g, b;
    float constant, linear, quadratic;
    int padding_a, padding_b;  // uniform arrays go in steps of 16 bytes
};

// What changes between draws; push constants, after MarchParams.
struct ReliefUniforms {
    float height_scale;
    float zero_level;
    float shadow_bias;  // gap under a light ray's end, in heights (techniques/shadow_bias.h)
};

#endif
