// What all programs of fur share: the coat, the two cameras and the shape that all strands around a place have in common.
#include "shared/coat.h"

layout(set = 0, binding = 0) uniform Coat { CoatUniforms coat; };
layout(push_constant) uniform Push {
    mat4 to_clip;   // from fur space, of the eye or of the light
    mat4 to_light;  // from fur space to the light's picture: x and y in [0,1], z the distance from its plane
};
