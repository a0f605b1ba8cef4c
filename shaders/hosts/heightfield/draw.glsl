// What changes between draws.
#include "../../shared/draw_options.h"
#include "../../shared/heightfield.h"
#include "../../shared/march_params.h"
#include "../../shared/scene.h"

layout(push_constant) uniform Draw {
    MarchParams march;
    ReliefUniforms relief;
    DrawNumbers numbers;
};
