// Wind-blown sand.
#include "textures/curves.h"
#include "textures/materials.h"
#include "textures/noise.h"

namespace relievo {

SurfaceFunction dunes(const Detail& detail) {
    const FractalNoise bend({.cells_u = 2, .cells_v = 2, .octaves = 3, .gain = 0.4f}, detail, 1);
    const FractalNoise grain({.cells_u = 128, .cells_v = 128, .octaves = 3, .gain = 0.8f}, detail, 2);
    return [=](Vec2f uv) -> SurfacePoint {
        const float phase = 2 * uv.x + uv.y + 0.35f * bend(uv);
        const float t = phase - std::floor(phase);
        const float wave = t < 0.68f ? 0.5f - 0.5f * cos_turns(0.5f * t / 0.68f) : 0.5f + 0.5f * cos_turns(0.5f * (t - 0.68f) / 0.32f);
        const float ripple = cos_turns(48 * uv.x + 6 * bend(uv));
        return {wave + 0.006f * ripple, Vec3f{0.83f, 0.70f, 0.51f} * (1 + 0.05f * grain(uv) - 0.02f * ripple)};
    };
}

}  // namespace relievo
