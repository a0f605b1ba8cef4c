// Ornament cut into limestone.
#include "textures/curves.h"
#include "textures/distance.h"
#include "textures/materials.h"
#include "textures/noise.h"

namespace relievo {

SurfaceFunction engraving(const Detail& detail) {
    const FractalNoise grain({.cells_u = 16, .cells_v = 16, .octaves = 6, .gain = 0.6f}, detail, 1);
    const float wall = std::max(0.0015f, detail.texel_uv);
    return [=](Vec2f uv) -> SurfacePoint {
        const float g = grain(uv);
        const Vec2f p = uv - Vec2f{0.5f, 0.5f};
        const float frame = std::abs(box_distance(p, {0.44f, 0.44f})) - 0.012f;
        const float ring = std::abs(length(p) - 0.3f) - 0.015f;
        const float inner = std::abs(length(p) - 0.2f) - 0.008f;
        const float cut = smooth_ramp(0, -wall, std::min({frame, ring, inner}));
        return {mix(0.92f, 0.1f, cut) + 0.04f * g, mix(Vec3f{0.80f, 0.77f, 0.71f}, Vec3f{0.70f, 0.66f, 0.58f}, cut) * (1 + 0.06f * g)};
    };
}

}  // namespace relievo
