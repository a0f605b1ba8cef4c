// What the programs of uniform layers share.
#include "shared/layers.h"

layout(set = 0, binding = 0) uniform Layers { LayersUniforms fur; };
layout(push_constant) uniform Push {
    mat4 to_clip;     // from fur space
    int first_layer;  // 0: the skin itself
};
