// What every host of the height-field family shares: the types, the technique's one name, its settings.
#include "../../shared/draw_options.h"
#include "../../shared/heightfield.h"
#include "../../shared/march_params.h"
#include "../../shared/scene.h"

layout(push_constant) uniform Draw {
    MarchParams march;
    ReliefUniforms relief;
    DrawNumbers numbers;
};

// The technique under test; the build appends a file that defines it.
SurfaceHit technique(SurfaceRay ray, MarchParams params);
