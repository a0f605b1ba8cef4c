// What every host of the height-field family shares: the types, the technique's one name, its settings.
#include "draw.glsl"

// The technique under test; the build appends a file that defines it.
SurfaceHit technique(SurfaceRay ray, MarchParams params);
