// Emboss bump mapping (Peeples, Michael 1999): the height here less the height toward the light stands for Lambert's n.l. It is that
// to first order in the slope; slopes across the light are not seen.
#include "contract/random_fields.h"
#include "contract/trace.h"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
namespace relievo::glsl {
namespace {
#include "shading/emboss.glsl"
}
}  // namespace relievo::glsl
#pragma GCC diagnostic pop

namespace relievo::contract {
namespace {

constexpr glsl::vec2 middle{0.4f, 0.5f};

// h rises by `slope` per unit of u and `across` per unit of v around the middle of the field.
MapSet tilted(float slope, float across) {
    MapSet maps;
    maps.height = HeightField(64, 64);
    for (int j = 0; j < 64; ++j)
        for (int i = 0; i < 64; ++i)
            maps.height.texels(i, j) = 0.5f + slope * ((static_cast<float>(i) + 0.5f) / 64 - middle.x) + across * ((static_cast<float>(j) + 0.5f) / 64 - middle.y);
    return maps;
}

float emboss(const MapSet& maps, float height_scale, glsl::vec3 light) {
    glsl::bound_maps = {.maps = &maps, .readable = MapFlags().set(index_of(Map::height))};
    return glsl::emboss_diffuse(middle, finest, height_scale, light);
}

TEST(EmbossBump, is_lambert_to_first_order) {
    const glsl::vec3 light = view_from(40, 0);
    for (const float slope : {-0.4f, -0.1f, 0.0f, 0.1f, 0.4f}) {
        const float s = 0.2f;
        const float tilt = slope * s;
        const float lambert = dot(normalize(Vec3f{-tilt, 0, 1}), light);
        // 1 - 1/|n| is at most half the tilt squared.
        EXPECT_NEAR(emboss(tilted(slope, 0), s, light), lambert, 0.5f * tilt * tilt + 1e-5f) << slope;
    }
    // Facing the light it is brighter than the plane, facing away darker: the light comes from +u, where a rising slope faces away.
    EXPECT_LT(emboss(tilted(0.4f, 0), 0.2f, light), light.z - 0.05f);
    EXPECT_GT(emboss(tilted(-0.4f, 0), 0.2f, light), light.z + 0.05f);
}

TEST(EmbossBump, does_not_see_slopes_across_the_light) {
    const glsl::vec3 light = view_from(40, 0);
    EXPECT_NEAR(emboss(tilted(0, 0.5f), 2.0f, light), light.z, 1e-5f);
    EXPECT_NEAR(dot(normalize(Vec3f{0, -0.5f * 2.0f, 1}), light), light.z / std::sqrt(2.0f), 1e-5f) << "where Lambert does";
}

TEST(EmbossBump, stays_a_share_of_the_light) {
    const MapSet maps = baked_maps(rough_field(6), 1.0f);
    glsl::bound_maps = {.maps = &maps, .readable = MapFlags().set(index_of(Map::height))};
    int black = 0;
    int burnt = 0;
    for (int i = 0; i < 500; ++i) {
        const float e = glsl::emboss_diffuse({0.002f * static_cast<float>(i), 0.71f}, finest, 1.0f, view_from(30, 55));
        ASSERT_GE(e, 0);
        ASSERT_LE(e, 1);
        black += e == 0 ? 1 : 0;
        burnt += e == 1 ? 1 : 0;
    }
    EXPECT_GT(black, 50);
    EXPECT_GT(burnt, 50);
}

}  // namespace
}  // namespace relievo::contract
