// A slab of veined limestone with lettering, Greek key, rosettes and laurel cut into it.
#include "textures/carving.h"
#include "textures/cellular.h"
#include "textures/curves.h"
#include "textures/distance.h"
#include "textures/hash.h"
#include "textures/lettering.h"
#include "textures/materials.h"
#include "textures/noise.h"
#include "textures/ornament.h"

#include <memory>

namespace relievo {

namespace {

constexpr float panel = 0.345f;  // half edge of the tooled field
constexpr float slab = 0.4955f;  // half edge of the slab; slabs stand a joint apart

std::vector<Groove> drawing() {
    const Section letters{.wall = 0.55f, .slope = 42, .floor = 0.93f};
    const Section key{.wall = 0.42f, .slope = 14, .floor = 0.5f};
    const Section fine{.wall = 0.40f, .slope = 40, .floor = 0.5f};
    const Section petals{.wall = 0.16f, .slope = 34, .floor = 0.50f};

    std::vector<Groove> all = inscription("RELIEVO", {0, 0}, 0.136f, letters);
    const auto add = [&](const std::vector<Groove>& more) { all.insert(all.end(), more.begin(), more.end()); };
    add(meander_frame(0.378f, 0.448f, 10, 0.0036f, key));
    add(square_rule({0, 0}, 0.470f, 0.0018f, fine));
    add(square_rule({0, 0}, 0.360f, 0.0030f, key));
    for (const float s : {-1.0f, 1.0f}) {
        all.push_back(rule({-0.325f, s * 0.0965f}, {0.325f, s * 0.0965f}, 0.0016f, fine));
        all.push_back(rule({-0.325f, s * 0.1055f}, {0.325f, s * 0.1055f}, 0.0030f, key));
        const Vec2f middle{0, s * 0.224f};
        all.push_back(circle(middle, 0.1035f, 0.0030f, key));
        all.push_back(circle(middle, 0.0945f, 0.0013f, fine));
        add(rosette(middle, 0.086f, 12, petals));
        for (const float t : {-1.0f, 1.0f}) {
            add(laurel({t * 0.122f, s * 0.175f}, {t * 0.312f, s * 0.275f}, -0.13f * s * t, 6, petals));
        }
    }
    return all;
}

}  // namespace

SurfaceFunction engraving(const Detail& detail) {
    const auto carving = std::make_shared<const Carving>(drawing());
    const FractalNoise cloud({.cells_u = 3, .cells_v = 3, .octaves = 5, .gain = 0.55f}, detail, 1);
    const FractalNoise vein({.cells_u = 2, .cells_v = 3, .octaves = 4, .gain = 0.55f}, detail, 2);
    const FractalNoise grain({.cells_u = 110, .cells_v = 110, .octaves = 3, .gain = 0.8f}, detail, 3);
    const FractalNoise chips({.cells_u = 90, .cells_v = 90, .octaves = 2, .gain = 0.6f}, detail, 4);
    const FractalNoise stroke({.cells_u = 14, .cells_v = 14, .octaves = 2, .gain = 0.6f}, detail, 5);
    const float wall = std::max(0.0014f, 1.3f * detail.sample_uv);

    return [=](Vec2f uv) -> SurfacePoint {
        const Vec2f p{uv.x - static_cast<float>(floor_index(uv.x)) - 0.5f, uv.y - static_cast<float>(floor_index(uv.y)) - 0.5f};
        const float clouds = cloud(uv);
        const float g = grain(uv);
        const float chip = chips(uv);
        const float strokes = stroke(uv);

        // Edges are not drawn with a ruler, and here and there the stone has flaked.
        const float flake = smooth_ramp(0.50f, 0.85f, chip);
        const float ragged = 0.0005f * chip + 0.0016f * flake;
        const Cut cut = carving->at(p, wall, ragged);
        const float field = box_distance(p, {panel, panel});
        const float edge = box_distance(p, {slab, slab}, 0.003f) + 0.0010f * chip + 0.004f * flake;

        // The field is dressed with a claw chisel: parallel furrows in short strokes. The frame is rubbed smooth.
        const float furrow = 26 * uv.x + 79 * uv.y + 0.33f * strokes;
        const float tooth = cos_turns(furrow) * saturate(0.50f + 1.1f * strokes);
        const float tooled = smooth_ramp(0.0f, -0.003f, field);
        float height = 0.95f + 0.008f * clouds + 0.006f * g;
        height += tooled * (0.017f * tooth - 0.028f + 0.012f * strokes);

        // Pores of the stone.
        const Cellular pore = cellular(uv, {.cells_u = 64, .cells_v = 64, .jitter = 0.45f, .seed = detail.seed + 9});
        const float lot = unit(pore.id);
        const float pore_size = lot < 0.045f ? 0.08f + 4.5f * lot : 0.0f;
        const float hollow = pore_size > 0 ? smooth_ramp(pore_size, 0.4f * pore_size, pore.nearest + 0.06f * g) : 0.0f;
        height -= 0.10f * hollow;

        // Worn arris, groove with the chisel's facets on its bed, joint between slabs.
        height -= 0.035f * smooth_ramp(0.0035f, 0.0f, cut.distance);
        height -= cut.depth;
        const float in_groove = smooth_ramp(0.0f, -wall, cut.distance);
        const float facet = cos_turns(70 * uv.x - 44 * uv.y + 1.5f * strokes);
        height += in_groove * (0.014f * facet + 0.012f * g);
        const float joint = smooth_ramp(-wall, 0.0f, edge);
        height -= 0.05f * smooth_ramp(-0.007f, -0.0f, edge) + 0.80f * joint;

        // Veins lie where a warped noise changes sign (Perlin 1985, marble).
        const float bent = vein(uv + Vec2f{0.05f, 0.035f} * clouds);
        const float hair = smooth_ramp(0.030f, 0.004f, std::abs(bent)) * smooth_ramp(-0.35f, 0.25f, clouds);
        const float halo = smooth_ramp(0.20f, 0.0f, std::abs(bent));
        Vec3f stone = mix(Vec3f{0.800f, 0.770f, 0.710f}, Vec3f{0.725f, 0.680f, 0.605f}, saturate(0.45f + 0.85f * clouds));
        stone = mix(stone, Vec3f{0.690f, 0.650f, 0.600f}, 0.45f * halo);
        stone = mix(stone, Vec3f{0.505f, 0.440f, 0.375f}, 0.75f * hair);
        stone = stone * (1 + 0.035f * g + tooled * 0.025f * tooth);
        stone = mix(stone, Vec3f{0.815f, 0.795f, 0.750f}, 0.25f * tooled);
        // Dust and lichen have settled in the cuts; fresh flakes are pale.
        const float deep = saturate(cut.depth / 0.6f);
        stone = mix(stone, Vec3f{0.520f, 0.465f, 0.385f} * (1 + 0.10f * g), 0.50f * deep * in_groove + 0.55f * hollow);
        stone = mix(stone, Vec3f{0.600f, 0.560f, 0.490f}, 0.25f * smooth_ramp(0.006f, 0.0f, cut.distance) * (1 - in_groove));
        stone = mix(stone, Vec3f{0.860f, 0.840f, 0.800f}, 0.5f * flake * (1 - in_groove) * smooth_ramp(0.005f, 0.0f, cut.distance));
        stone = mix(stone, Vec3f{0.330f, 0.290f, 0.240f} * (1 + 0.2f * g), joint);
        return {height, stone};
    };
}

}  // namespace relievo
