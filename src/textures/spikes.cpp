// Thin pins of differing height on a dark ground.
#include "textures/cellular.h"
#include "textures/curves.h"
#include "textures/hash.h"
#include "textures/materials.h"
#include "textures/noise.h"

namespace relievo {

SurfaceFunction spikes(const Detail& detail) {
    const FractalNoise grain({.cells_u = 32, .cells_v = 32, .octaves = 5, .gain = 0.6f}, detail, 1);
    const float radius = std::max(0.0015f, 0.75f * detail.texel_uv);
    return [=](Vec2f uv) -> SurfacePoint {
        const Cellular c = cellular(uv, {.cells_u = 22, .cells_v = 22, .jitter = 0.3f, .seed = detail.seed});
        Dice dice(c.id);
        const float g = grain(uv);
        const float pin = (0.4f + 0.6f * dice.roll()) * smooth_ramp(1.5f * radius, 0.3f * radius, c.nearest / 22);
        const float ground = 0.04f + 0.02f * g;
        const Vec3f rust = mix(Vec3f{0.40f, 0.22f, 0.13f}, Vec3f{0.66f, 0.62f, 0.57f}, smooth_ramp(0.3f, 0.8f, pin));
        return {std::max(pin, ground), pin > ground ? rust : Vec3f{0.16f, 0.15f, 0.15f} * (1 + 0.3f * g)};
    };
}

}  // namespace relievo
