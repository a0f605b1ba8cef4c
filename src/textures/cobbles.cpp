// River stones bedded in sand.
#include "textures/cellular.h"
#include "textures/curves.h"
#include "textures/hash.h"
#include "textures/materials.h"
#include "textures/noise.h"

namespace relievo {

SurfaceFunction cobbles(const Detail& detail) {
    const FractalNoise grain({.cells_u = 32, .cells_v = 32, .octaves = 5, .gain = 0.6f}, detail, 1);
    return [=](Vec2f uv) -> SurfacePoint {
        const Cellular c = cellular(uv, {.cells_u = 7, .cells_v = 7, .jitter = 0.35f, .seed = detail.seed});
        Dice dice(c.id);
        const float g = grain(uv);
        const float t = (c.second - c.nearest) * 1.4f - 0.12f;
        const float stone = shoulder(t) * (0.75f + 0.2f * dice.roll()) + 0.03f * g;
        const float sand = 0.15f + 0.05f * g;
        const float on_stone = smooth_ramp(-0.02f, 0.04f, stone - sand);
        const Vec3f rock = mix(Vec3f{0.40f, 0.40f, 0.41f}, Vec3f{0.60f, 0.55f, 0.48f}, dice.roll()) * (1 + 0.15f * g);
        return {smooth_max(stone, sand, 0.05f), mix(Vec3f{0.50f, 0.43f, 0.33f} * (1 + 0.2f * g), rock, on_stone)};
    };
}

}  // namespace relievo
