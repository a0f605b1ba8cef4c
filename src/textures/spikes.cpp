// Iron nails of differing height through dark old planks: far thinner than the step of a linear search.
#include "textures/cellular.h"
#include "textures/curves.h"
#include "textures/hash.h"
#include "textures/materials.h"
#include "textures/noise.h"

namespace relievo {

namespace {

constexpr int pins_across = 25;
constexpr int planks = 4;

// At 30 degrees and the scene's height_scale of 0.12 a ray moves 0.12 / tan 30 = 0.208 UV while it falls through the slab; a 64th
// of that is 0.00325 UV. A nail is twice this wide at half its height, three times at the foot, once near the point.
constexpr float nail_radius = 0.00125f;

}  // namespace

SurfaceFunction spikes(const Detail& detail) {
    const FractalNoise fibre({.cells_u = 84, .cells_v = 5, .octaves = 3, .gain = 0.8f}, detail, 1);
    const FractalNoise hair({.cells_u = 230, .cells_v = 14, .octaves = 1}, detail, 4);
    const FractalNoise wear({.cells_u = 12, .cells_v = 8, .octaves = 3, .gain = 0.55f}, detail, 2);
    const FractalNoise swell({.cells_u = 3, .cells_v = 3, .octaves = 1}, detail, 3);
    // The nearest sample lies within 0.71 of the axis; were nails thinner than this, their lengths would be a matter of chance.
    const float radius = std::max(nail_radius, 0.95f * detail.sample_uv);
    return [=](Vec2f uv) -> SurfacePoint {
        const Cellular c = cellular(uv, {.cells_u = pins_across, .cells_v = pins_across, .jitter = 0.44f, .seed = detail.seed});
        Dice dice(c.id);
        const float d = c.nearest / pins_across;

        // Planks along v, each from another tree: fibres, year rings cut lengthwise, a dark gap on either side.
        const float across = uv.x * planks;
        const int plank = lattice_index(floor_index(across), planks);
        Dice tree(hash(detail.seed, 0x91a0u + static_cast<std::uint32_t>(plank)));
        const Vec2f own = uv + Vec2f{0, tree.roll()};
        const float fibres = fibre(own) + 0.55f * hair(own);
        const float worn = wear(own);
        const float in_plank = across - static_cast<float>(floor_index(across)) - 0.5f;
        const float ring = in_plank * tree.roll(5.0f, 9.0f) + 1.1f * worn + tree.roll();
        const float year = ring - static_cast<float>(floor_index(ring));
        const float late_wood = smooth_ramp(0.35f, 0.85f, year) * smooth_ramp(1.0f, 0.85f, year);
        const float edge = (0.5f - std::abs(in_plank)) / planks + 0.0010f * worn;
        const float gap = smooth_ramp(0.0055f, 0.0030f, edge);
        const float ground = (0.075f + 0.012f * tree.roll(-1, 1) + 0.0035f * late_wood + 0.009f * fibres + 0.005f * worn -
                              0.020f * smooth_ramp(0.012f, 0.004f, edge)) *
                             (1 - gap);

        const float lightness = tree.roll(0.82f, 1.12f);
        Vec3f colour =
            mix(Vec3f{0.365f, 0.310f, 0.260f}, Vec3f{0.205f, 0.165f, 0.135f}, saturate(0.30f + 0.45f * late_wood + 0.65f * fibres));
        colour =
            mix(colour, Vec3f{0.375f, 0.355f, 0.330f} * (1 + 0.25f * fibres), 0.40f * smooth_ramp(0.0f, 0.7f, worn)) * lightness;
        // Rust has bled from the nails, farther along the fibres than across.
        const Vec2f bled{c.offset.x, c.offset.y * 0.42f};
        const float stain = smooth_ramp(0.26f, 0.04f, length(bled) + 0.25f * worn + 0.16f * fibres);
        colour = mix(colour, Vec3f{0.270f, 0.170f, 0.115f} * (1 - 0.25f * fibres), 0.55f * stain);
        colour = mix(colour, Vec3f{0.090f, 0.080f, 0.075f}, gap);
        if (d > 1.7f * radius) return {ground, colour};

        // Where the pin stands decides its length: fields of long ones, gaps of short ones, here and there a stump or none at all.
        const Vec2f foot = uv - c.offset / pins_across;
        const float fate = dice.roll();
        const float reach = saturate(0.70f + 0.40f * swell(foot) + dice.roll(-0.26f, 0.26f)) * (fate < 0.10f ? 0.4f : 1.0f);
        const float out = d / (radius * dice.roll(0.92f, 1.05f));
        const float pin = fate > 0.95f ? 0.0f : reach * (smooth_ramp(1.5f, 0.4f, out) - 0.06f * out);
        const float bright = dice.roll();
        if (pin > ground) {
            // Rust at the foot, dark iron along the shaft, rubbed bright at the point; no two are alike.
            const float up = pin / std::max(reach, 0.1f);
            const Vec3f iron = mix(Vec3f{0.520f, 0.400f, 0.320f}, Vec3f{0.640f, 0.620f, 0.600f}, bright);
            const Vec3f point = mix(Vec3f{0.760f, 0.690f, 0.620f}, Vec3f{0.900f, 0.890f, 0.875f}, bright);
            colour =
                mix(mix(Vec3f{0.480f, 0.310f, 0.200f}, iron, smooth_ramp(0.08f, 0.35f, up)), point, smooth_ramp(0.30f, 0.75f, up));
        }
        return {std::max(pin, ground), colour};
    };
}

}  // namespace relievo
