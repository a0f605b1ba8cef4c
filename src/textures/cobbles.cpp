// River stones of many sizes and rocks, bedded in sand and grit.
#include "textures/cellular.h"
#include "textures/curves.h"
#include "textures/hash.h"
#include "textures/materials.h"
#include "textures/noise.h"
#include "textures/stone_packing.h"

#include <array>
#include <memory>

namespace relievo {

namespace {

struct Rock {
    Vec3f colour;
    float speckle;  // strength of light and dark minerals
    float mottle;   // strength of the slow change of tone
    float veins;    // strength of quartz veins
    float share;
};

constexpr std::array<Rock, 8> rocks{{
    {{0.500f, 0.495f, 0.480f}, 0.90f, 0.5f, 0.0f, 0.22f},  // granite
    {{0.590f, 0.540f, 0.470f}, 0.40f, 0.9f, 0.0f, 0.20f},  // sandstone
    {{0.400f, 0.415f, 0.430f}, 0.25f, 0.6f, 0.8f, 0.18f},  // greywacke
    {{0.300f, 0.305f, 0.315f}, 0.20f, 0.4f, 0.5f, 0.12f},  // basalt
    {{0.500f, 0.405f, 0.365f}, 0.70f, 0.7f, 0.0f, 0.10f},  // porphyry
    {{0.660f, 0.630f, 0.585f}, 0.25f, 0.8f, 0.0f, 0.08f},  // quartzite
    {{0.430f, 0.438f, 0.400f}, 0.40f, 0.8f, 0.4f, 0.06f},  // greenstone
    {{0.560f, 0.480f, 0.380f}, 0.20f, 1.0f, 0.3f, 0.04f},  // chert
}};

struct Look {
    Rock rock;
    Vec2f noise_shift;
    Vec2f tilt;
    float top, lightness, flatness, warmth;
};

Look look_of(const Stone& stone) {
    Dice dice(stone.id);
    Look look;
    float pick = dice.roll();
    look.rock = rocks.back();
    for (const Rock& r : rocks) {
        if ((pick -= r.share) < 0) {
            look.rock = r;
            break;
        }
    }
    look.noise_shift = {dice.roll(), dice.roll()};
    look.tilt = {dice.roll(-0.9f, 0.9f), dice.roll(-0.9f, 0.9f)};
    // About half of every stone is buried, so a large one stands higher.
    look.top = 0.26f + 6.0f * stone.radius + dice.roll(-0.07f, 0.09f);
    look.lightness = dice.roll(0.86f, 1.12f);
    look.flatness = dice.roll(0.75f, 1.0f);
    look.warmth = dice.roll(-0.018f, 0.018f);
    return look;
}

}  // namespace

SurfaceFunction cobbles(const Detail& detail) {
    const auto packing = std::make_shared<const StonePacking>(0.105f, 0.022f, detail.seed);
    std::vector<Look> looks;
    for (const Stone& s : packing->stones()) looks.push_back(look_of(s));

    const FractalNoise warp_u({.cells_u = 8, .cells_v = 8, .octaves = 2, .gain = 0.35f}, detail, 1);
    const FractalNoise warp_v({.cells_u = 8, .cells_v = 8, .octaves = 2, .gain = 0.35f}, detail, 2);
    const FractalNoise lumps({.cells_u = 9, .cells_v = 9, .octaves = 4, .gain = 0.5f}, detail, 3);
    const FractalNoise grain({.cells_u = 80, .cells_v = 80, .octaves = 3, .gain = 0.85f}, detail, 4);
    const FractalNoise soil({.cells_u = 5, .cells_v = 5, .octaves = 3, .gain = 0.6f}, detail, 5);

    return [=](Vec2f uv) -> SurfacePoint {
        // Borders that are not quite the straight lines of a diagram.
        const Vec2f bent = uv + Vec2f{warp_u(uv), warp_v(uv)} * 0.011f;
        const StonePlace place = packing->at(bent);
        const Stone& stone = packing->stones()[static_cast<std::size_t>(place.stone)];
        const Look& look = looks[static_cast<std::size_t>(place.stone)];
        const Vec2f own = uv + look.noise_shift;

        const float lump = lumps(own);
        const float g = grain(own);
        const float earth = soil(uv);

        // A round shoulder from the border inward, on a dome that keeps rising to the middle.
        const float reach = look.flatness * 0.95f * stone.radius;
        const float t = (place.inside - 0.0035f) / reach;
        const float out = place.from_core / (1.35f * stone.radius);
        float rise = shoulder(t) * (1 - 0.20f * std::min(1.5f, out * out));
        rise += 0.07f * lump * saturate(3 * t);
        float stone_height = look.top * rise + dot(look.tilt, place.offset) * saturate(2 * t) + 0.009f * g;
        if (t < 0) stone_height += 3 * t;

        // Sand and grit between: grains large enough to be seen, each its own colour, on sand too fine for that. High on a stone
        // there is none, and drawing it would cost a third of the time.
        const bool bare = stone_height > 0.68f;
        float sand_height = 0.16f + 0.07f * earth;
        Vec3f sand = mix(Vec3f{0.455f, 0.400f, 0.320f}, Vec3f{0.350f, 0.305f, 0.245f}, saturate(0.5f + 0.8f * earth));
        if (!bare) {
            const Cellular grit = cellular(uv, {.cells_u = 110, .cells_v = 110, .jitter = 0.45f, .seed = detail.seed + 5});
            Dice pebble(grit.id);
            const float size = pebble.roll(0.0f, 0.62f);
            const float pebble_rise = size > 0.3f ? shoulder((size - grit.nearest) / size) * size : 0.0f;
            const float fine = grain(uv);
            sand_height += 0.012f * fine + 0.045f * pebble_rise;
            sand = sand * (1 + 0.20f * fine);
            const float tone = pebble.roll(0.65f, 1.25f);
            const Vec3f pebble_colour = mix(Vec3f{0.48f, 0.45f, 0.40f}, Vec3f{0.54f, 0.46f, 0.36f}, pebble.roll()) * tone;
            sand = mix(sand, pebble_colour, saturate(3 * pebble_rise));
        }

        const float above = stone_height - sand_height;
        // Sand lies thinly on the stone's skirt before it ends.
        const float on_stone = smooth_ramp(-0.005f, 0.02f, above);
        const float dusty = smooth_ramp(0.24f + 0.12f * earth, 0.02f, above + 0.05f * lump);

        if (on_stone <= 0) return {smooth_max(stone_height, sand_height, 0.03f), sand};

        Vec3f rock = look.rock.colour * (look.lightness * (1 + 0.16f * look.rock.mottle * lump));
        rock = rock + Vec3f{look.warmth, 0, -look.warmth} + Vec3f{0.03f, 0.005f, -0.02f} * (look.rock.mottle * earth);
        rock = rock * (1 + 0.10f * g);
        const float minerals = look.rock.speckle;
        rock = mix(rock, Vec3f{0.20f, 0.19f, 0.19f}, minerals * 0.65f * smooth_ramp(0.28f, 0.6f, g));
        rock = mix(rock, Vec3f{0.76f, 0.74f, 0.71f}, minerals * 0.55f * smooth_ramp(0.28f, 0.6f, -g));
        if (look.rock.veins > 0) {
            // Quartz fills cracks: thin where the noise changes sign.
            const float crack = std::abs(lump + 0.25f * look.warmth / 0.018f);
            rock = mix(rock, Vec3f{0.72f, 0.70f, 0.67f}, look.rock.veins * 0.8f * smooth_ramp(0.028f, 0.008f, crack));
        }
        // Feet rub the tops paler; dust and damp darken the skirts.
        rock = rock * (0.94f + 0.10f * smooth_ramp(0.35f, 0.85f, rise));
        rock = mix(rock, sand * 0.92f, 0.72f * dusty);
        return {smooth_max(stone_height, sand_height, 0.03f), mix(sand, rock, on_stone)};
    };
}

}  // namespace relievo
