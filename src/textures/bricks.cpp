// Fired clay bricks in running bond with deep, flat joints.
#include "textures/curves.h"
#include "textures/distance.h"
#include "textures/hash.h"
#include "textures/materials.h"
#include "textures/noise.h"

namespace relievo {

SurfaceFunction bricks(const Detail& detail) {
    const FractalNoise wobble({.cells_u = 24, .cells_v = 24, .octaves = 3}, detail, 1);
    const FractalNoise grain({.cells_u = 64, .cells_v = 64, .octaves = 4, .gain = 0.7f}, detail, 2);
    return [=](Vec2f uv) -> SurfacePoint {
        const float y = uv.y * 8;
        const int course = static_cast<int>(std::floor(y));
        const float x = uv.x * 3 + (course & 1 ? 0.5f : 0.0f);
        const int column = wrap_index(static_cast<int>(std::floor(x)), 3);
        Dice dice(hash(detail.seed, static_cast<std::uint32_t>(course * 3 + column)));
        const Vec2f p{(x - std::floor(x) - 0.5f) / 3, (y - std::floor(y) - 0.5f) / 8};
        const float d = box_distance(p, {1.0f / 6 - 0.01f, 1.0f / 16 - 0.01f}, 0.008f) + 0.003f * wobble(uv);
        const float g = grain(uv);
        const float on_brick = smooth_ramp(0.0f, -0.003f, d);
        const float top = 0.85f + 0.1f * dice.roll() + 0.03f * g + 0.1f * (shoulder(-d / 0.012f) - 1);
        const Vec3f clay = mix(Vec3f{0.50f, 0.25f, 0.19f}, Vec3f{0.68f, 0.38f, 0.27f}, dice.roll()) * (1 + 0.15f * g);
        const Vec3f mortar = Vec3f{0.62f, 0.59f, 0.54f} * (1 + 0.2f * g);
        return {mix(0.1f + 0.05f * g, top, on_brick), mix(mortar, clay, on_brick)};
    };
}

}  // namespace relievo
