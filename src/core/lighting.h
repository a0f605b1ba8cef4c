// Lights and the Phong surface they fall on; world space, linear RGB.
//   I = ambient * colour + sum over lights of visibility / (a + b d + c d^2) * light * (colour * max(0, n.l) + specular * max(0, r.v)^shininess)
// with r the mirror image of l about n and d the distance to the light (Phong 1975; attenuation as in the fixed pipelines).
#pragma once

#include "core/vec.h"

#include <vector>

namespace relievo {

struct Light {
    Vec3f position{0, 0, 1};   // or, for a directional light, the unit direction toward it
    bool directional = true;   // no attenuation and no distance
    Vec3f colour{1, 1, 1};
    float constant = 1, linear = 0, quadratic = 0;  // a, b, c
};

// The first light is the key light: the one whose self-shadow is cast and judged.
struct Lighting {
    Vec3f ambient{0.1f, 0.1f, 0.1f};
    std::vector<Light> lights;
    float specular = 0.08f;
    float shininess = 24;
    Vec3f background{0.02f, 0.02f, 0.024f};
};

}  // namespace relievo
