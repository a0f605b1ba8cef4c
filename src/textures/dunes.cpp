// Wind-blown sand: long sinuous dunes with slip faces on the lee side, and ripples that bend around them.
#include "textures/curves.h"
#include "textures/hash.h"
#include "textures/materials.h"
#include "textures/noise.h"
#include "textures/wave_field.h"

#include <memory>

namespace relievo {

SurfaceFunction dunes(const Detail& detail) {
    const FractalNoise sway({.cells_u = 2, .cells_v = 3, .octaves = 3, .gain = 0.34f}, detail, 1);
    const FractalNoise stature({.cells_u = 2, .cells_v = 2, .octaves = 2, .gain = 0.4f}, detail, 2);
    const FractalNoise gust({.cells_u = 4, .cells_v = 4, .octaves = 2, .gain = 0.5f}, detail, 3);
    const FractalNoise grain({.cells_u = 150, .cells_v = 150, .octaves = 2, .gain = 1.0f}, detail, 4);
    const FractalNoise tone({.cells_u = 5, .cells_v = 5, .octaves = 4, .gain = 0.55f}, detail, 5);
    const FractalNoise tongues({.cells_u = 6, .cells_v = 40, .octaves = 2, .gain = 0.5f}, detail, 6);

    // The wind blows along u, a little toward v; whole numbers of waves close the tile.
    const auto dune_phase = [=](Vec2f uv) { return uv.x + uv.y + 0.20f * sway(uv); };
    // Ripples keep square to the wind, which the dunes turn aside: their phase follows the dunes' a little, and the gusts.
    const auto ripple_phase = [=](Vec2f uv) { return 40 * uv.x + 22 * uv.y + 1.7f * sway(uv) + 0.9f * gust(uv); };
    const auto ripples = std::make_shared<const WaveField>(30, ripple_phase, 0.17f, hash(detail.seed, 0xd0));

    return [=](Vec2f uv) -> SurfacePoint {
        const float phase = dune_phase(uv);
        const float t = phase - static_cast<float>(floor_index(phase));
        // Windward: a concave foot, then an even rise to the brink. Lee: sand at rest at its steepest angle, with a soft toe.
        const float windward = t * t * (2.55f - 1.10f * t) * 1.25f;
        const float fall = 1.35f * (1 - t) / 0.38f;
        const float lee = fall * fall / (fall + 0.25f);
        const float wave = smooth_min(windward, lee, 0.09f);
        const float size = 0.78f + 0.30f * stature(uv);

        const float slip = smooth_ramp(0.64f, 0.69f, t) * smooth_ramp(0.98f, 0.90f, t);
        const float ripple = ripples->at(uv);
        // A slip face is too steep and too young for ripples; in hollows they are largest.
        const float strength = (1 - 0.92f * slip) * (0.75f + 0.5f * smooth_ramp(0.6f, 0.0f, wave)) * (0.8f + 0.5f * stature(uv));
        const float crest = ripple + 0.28f * ripple * ripple;
        const float tongue = slip * tongues(uv);
        const float g = grain(uv);
        const float height = size * wave + 0.0036f * strength * crest + 0.006f * tongue + 0.0011f * g;

        const float slow = tone(uv);
        Vec3f sand = mix(Vec3f{0.765f, 0.640f, 0.470f}, Vec3f{0.700f, 0.565f, 0.400f}, saturate(0.5f + 0.8f * slow));
        // Coarse dark grains gather in the troughs, pale fine ones blow over the brink.
        sand = mix(sand, Vec3f{0.555f, 0.440f, 0.325f}, 0.24f * strength * smooth_ramp(0.25f, -0.8f, ripple));
        sand = mix(sand, Vec3f{0.815f, 0.705f, 0.545f}, 0.55f * slip + 0.12f * tongue);
        sand = sand * (1 + 0.055f * g);
        sand = mix(sand, Vec3f{0.36f, 0.29f, 0.23f}, 0.45f * smooth_ramp(0.55f, 0.9f, g));
        return {height, sand};
    };
}

}  // namespace relievo
