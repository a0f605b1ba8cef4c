// Fired clay bricks in running bond, chipped and worn, with raked joints of sandy mortar.
#include "textures/cellular.h"
#include "textures/curves.h"
#include "textures/distance.h"
#include "textures/hash.h"
#include "textures/materials.h"
#include "textures/noise.h"

#include <array>
#include <vector>

namespace relievo {

namespace {

constexpr int columns = 3;  // bricks of 215 x 65 mm with joints of 15 mm: three to a tile of 0.69 m, eight courses
constexpr int courses = 8;  // even, so that the half-brick shift closes
constexpr float joint = 0.023f;

struct Clay {
    Vec3f body, flash;  // the middle of a firing, and what the flame did to parts of the face
    float share;
};

constexpr std::array<Clay, 6> clays{{
    {{0.560f, 0.325f, 0.260f}, {0.460f, 0.265f, 0.225f}, 0.34f},
    {{0.610f, 0.385f, 0.300f}, {0.530f, 0.310f, 0.245f}, 0.24f},
    {{0.485f, 0.285f, 0.240f}, {0.390f, 0.240f, 0.215f}, 0.18f},
    {{0.660f, 0.465f, 0.370f}, {0.580f, 0.375f, 0.295f}, 0.11f},
    {{0.380f, 0.265f, 0.240f}, {0.290f, 0.235f, 0.230f}, 0.08f},
    {{0.540f, 0.380f, 0.320f}, {0.630f, 0.470f, 0.390f}, 0.05f},
}};

struct Brick {
    Clay clay;
    Vec2f half_size, shift, noise_shift;
    float turn;  // radians, small
    float top;   // height of the face
    Vec2f tilt;  // rise per UV
    float lightness;
    float wear;  // 0 sharp, 1 much chipped
};

std::vector<Brick> lay(std::uint32_t seed) {
    std::vector<Brick> wall;
    for (int k = 0; k < columns * courses; ++k) {
        Dice dice(hash(seed, 0xb21c0000u + static_cast<std::uint32_t>(k)));
        Brick b;
        float pick = dice.roll();
        b.clay = clays.back();
        for (const Clay& c : clays) {
            if ((pick -= c.share) < 0) {
                b.clay = c;
                break;
            }
        }
        b.half_size = {0.5f / columns - joint / 2 + dice.roll(-0.0030f, 0.0015f),
                       0.5f / courses - joint / 2 + dice.roll(-0.0025f, 0.0012f)};
        b.shift = {dice.roll(-0.0025f, 0.0025f), dice.roll(-0.0015f, 0.0015f)};
        b.noise_shift = {dice.roll(), dice.roll()};
        b.turn = dice.roll(-0.012f, 0.012f);
        b.top = 0.88f + dice.roll(-0.10f, 0.07f);
        b.tilt = {dice.roll(-0.25f, 0.25f), dice.roll(-0.6f, 0.6f)};
        b.lightness = dice.roll(0.90f, 1.09f);
        b.wear = dice.roll();
        wall.push_back(b);
    }
    return wall;
}

}  // namespace

SurfaceFunction bricks(const Detail& detail) {
    const std::vector<Brick> wall = lay(detail.seed);
    const FractalNoise wobble({.cells_u = 20, .cells_v = 20, .octaves = 3, .gain = 0.45f}, detail, 1);
    const FractalNoise chips({.cells_u = 26, .cells_v = 26, .octaves = 3, .gain = 0.6f}, detail, 2);
    const FractalNoise lumps({.cells_u = 9, .cells_v = 14, .octaves = 3}, detail, 3);
    const FractalNoise grain({.cells_u = 96, .cells_v = 96, .octaves = 3, .gain = 0.8f}, detail, 4);
    const FractalNoise drag({.cells_u = 14, .cells_v = 110, .octaves = 2}, detail, 5);
    const FractalNoise weather({.cells_u = 3, .cells_v = 3, .octaves = 4, .gain = 0.55f}, detail, 6);
    const float wall_width = std::max(0.004f, 1.5f * detail.sample_uv);

    return [=](Vec2f uv) -> SurfacePoint {
        const float y = uv.y * courses;
        const int course = floor_index(y);
        const float x = uv.x * columns + ((course & 1) != 0 ? 0.5f : 0.0f);
        const int column = floor_index(x);
        const Brick& b = wall[static_cast<std::size_t>(lattice_index(course, courses) * columns + lattice_index(column, columns))];

        const Vec2f from_centre =
            Vec2f{(x - static_cast<float>(column) - 0.5f) / columns, (y - static_cast<float>(course) - 0.5f) / courses} - b.shift;
        const Vec2f p{from_centre.x + b.turn * from_centre.y, from_centre.y - b.turn * from_centre.x};
        const Vec2f own = uv + b.noise_shift;  // every brick reads another part of the noise

        const float wobbles = wobble(own);
        const float chip_noise = chips(own);
        const float edge = box_distance(p, b.half_size, 0.007f) + 0.0026f * wobbles;
        // A chip takes away more the nearer it is to an arris; inside the face nothing breaks off.
        const float near_edge = smooth_ramp(-0.022f, 0.0f, edge);
        const float chip = smooth_ramp(0.34f - 0.22f * b.wear, 0.62f - 0.2f * b.wear, chip_noise) * near_edge;
        const float d = edge + 0.0045f * chip;

        const float g = grain(uv);
        const float on_brick = smooth_ramp(wall_width * 0.5f, -wall_width * 0.5f, d);
        const float weathering = weather(uv);

        // Mortar: raked back to a flat bed, sand showing, fuller where the trowel slipped.
        const float bed = 0.09f + 0.040f * g + 0.05f * wobble(uv) + 0.03f * weathering + 0.12f * smooth_ramp(0.0065f, 0.0f, d);
        const float light_sand = ramp(0.25f, 0.7f, g);
        Vec3f mortar = mix(Vec3f{0.600f, 0.570f, 0.520f}, Vec3f{0.530f, 0.495f, 0.440f}, saturate(0.5f + 0.9f * weathering));
        mortar = mix(mortar * (1 + 0.16f * g), Vec3f{0.74f, 0.71f, 0.66f}, 0.5f * light_sand);
        if (on_brick <= 0) return {bed, mortar};

        const float lump = lumps(own);
        const float drags = drag(own);
        // Few of the cells hold a pit, small ones more often than large: gas bubbles and lost grit, longer than high.
        const Cellular pit = cellular(own + Vec2f{0.004f * wobbles, 0.003f * lump},
                                      {.cells_u = 50, .cells_v = 75, .jitter = 0.45f, .seed = detail.seed + 77});
        const float lot = unit(pit.id);
        const float pit_size = lot < 0.065f ? 0.13f + 1300 * lot * lot * lot : 0.0f;
        const float hollow = pit_size > 0 ? smooth_ramp(pit_size, 0.3f * pit_size, pit.nearest + 0.10f * g) * b.wear : 0.0f;

        const float rounding = 0.006f + 0.010f * b.wear;
        float top = b.top + dot(b.tilt, p) + 0.030f * lump + 0.016f * drags + 0.014f * g;
        top -= 0.16f * (1 - shoulder(-d / rounding));
        top -= 0.34f * chip * (0.8f + 0.5f * wobbles);
        top -= 0.11f * hollow;

        const float flame = smooth_ramp(-0.25f, 0.75f, lump + 0.35f * wobbles);
        Vec3f clay = mix(b.clay.body, b.clay.flash, flame) * b.lightness;
        clay = clay * (1 + 0.10f * g + 0.05f * drags);
        // Broken clay is lighter and more orange than the fired skin; the arrises are rubbed.
        clay = mix(clay, Vec3f{0.69f, 0.43f, 0.32f} * (1 + 0.12f * g), 0.55f * chip);
        clay = mix(clay, clay * 1.10f, near_edge * 0.5f * b.wear);
        clay = mix(clay, clay * 0.55f, 0.8f * hollow);
        // Lime bloom in some corners of the wall, soot in others.
        clay = mix(clay, Vec3f{0.75f, 0.71f, 0.67f}, 0.34f * smooth_ramp(0.18f, 0.75f, weathering + 0.25f * g + 0.15f * wobbles));
        clay = clay * (1 - 0.22f * smooth_ramp(-0.15f, -0.7f, weathering));
        // Grit of iron in the clay.
        clay = mix(clay, Vec3f{0.22f, 0.17f, 0.16f}, 0.6f * smooth_ramp(0.52f, 0.8f, -g));
        return {mix(bed, top, on_brick), mix(mortar, clay, smooth_ramp(wall_width * 0.5f, wall_width * 0.1f, d))};
    };
}

}  // namespace relievo
