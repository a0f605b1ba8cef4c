// Camera, base and lights.
#ifndef RELIEVO_HOSTS_SCENE
#define RELIEVO_HOSTS_SCENE
#include "../../shared/scene.h"

layout(set = 1, binding = 0, std140) uniform Scene {
    SceneUniforms scene;
    LightUniforms first_lights[first_lights_count];
};
layout(set = 1, binding = 1, std430) readonly buffer Lights { LightUniforms further_lights[]; };

LightUniforms light_at(int i) {
    LightUniforms light = first_lights[min(i, first_lights_count - 1)];
    if (i >= first_lights_count) light = further_lights[i - first_lights_count];
    return light;
}

#endif
