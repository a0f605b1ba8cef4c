#include "techniques/shadow_bias.h"

#include <algorithm>

namespace relievo {

float shadow_bias(const Technique& technique, const MarchParams& params) {
    if (technique.exact) return 0;
    // A light 30 degrees above the plane stands for all: searches that adapt to the angle differ little from there down.
    constexpr float light_z = 0.5f;
    const float error = technique.precision != nullptr ? technique.precision(params, light_z).error : 0.0f;
    return error > 0 ? std::max(0.005f, 2 * error) : 0.0005f;
}

}  // namespace relievo
