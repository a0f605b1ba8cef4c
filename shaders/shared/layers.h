// What the programs of uniform layers receive, in fur space. Scalars only, so that GLSL's and C++'s layouts are the same
// (render/layers_renderer.cpp asserts it).
#ifndef RELIEVO_SHARED_LAYERS_H
#define RELIEVO_SHARED_LAYERS_H

struct LayersUniforms {
    float eye_x, eye_y, eye_z;
    int layers;
    float key_x, key_y, key_z;   // unit, toward the light
    float fur_height;            // of the outermost layer
    float ambient, diffuse, specular, power;
    float skin_r, skin_g, skin_b;  // linear albedo under the fur
    float tilt, bend;              // of the strands of lapped patches, radians, as in strand_shape
};

// Values of the constant `lookup`.
const int lookup_cube = 0;
const int lookup_sphere = 1;
// Values of the constant `addressing`.
const int addressing_normal = 0;
const int addressing_position = 1;
const int addressing_sum = 2;

#endif
