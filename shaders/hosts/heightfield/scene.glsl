// Camera, base and lights.
#include "../../shared/scene.h"

layout(set = 1, binding = 0, std140) uniform Scene { SceneUniforms scene; };
layout(set = 1, binding = 1, std430) readonly buffer Lights { LightUniforms lights[]; };
