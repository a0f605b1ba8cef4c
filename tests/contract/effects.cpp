// Contract 7: every effect a row claims is measured present, and every one it does not claim absent. Each effect is a number that
// is 1 where the effect is whole and 0 where there is none.
#include "contract/profile.h"
#include "contract/trace.h"

namespace relievo::contract {
namespace {

class Effects : public EveryTechnique {};

constexpr float height_scale = 0.1f;
constexpr double elevation_deg = 25;

// A wall thicker than any ray is long, between floors wider than any shadow.
Profile wall() { return {.name = "wall", .kinks = {{24, 0.1}, {25, 0.9}, {45, 0.9}, {46, 0.1}}}; }

// From an eye or a lamp on the +u side, the floor this far behind the wall cannot be reached: texels, a texel clear of its ends.
bool behind_wall(double texel) {
    const double reach = (0.9 - 0.1) * static_cast<double>(height_scale) / std::tan(elevation_deg * std::numbers::pi / 180) * Profile::texels;
    const double x = texel - Profile::texels * std::floor(texel / Profile::texels);
    return x > 25 - reach + 1 && x < 24 - 1;
}

SurfaceRay toward_plus_u(float u, float zero_level) {
    return glsl::view_ray({u, 0.3f}, view_from(elevation_deg, 0), height_scale, zero_level, finest);
}

// How much of the true shift a plateau shows, worst over views from all sides and plateaux above and below the polygon.
struct Range {
    double least;
    double most;
};
Range parallax(const Technique& technique) {
    Range share{1e9, -1e9};
    for (const float height : {0.2f, 0.8f}) {
        const MapSet maps = baked_maps(HeightField(8, 8, height), height_scale);
        for (const double azimuth : {0.0, 77.0, 180.0, 260.0}) {
            const SurfaceRay ray = glsl::view_ray({0.3f, 0.6f}, view_from(60, azimuth), height_scale, 0.5f, finest);
            const glsl::vec2 shift = trace(technique, maps, ray, default_params(technique)).hit.uv - ray.uv;
            const glsl::vec2 expected = (height - 0.5f) * ray.uv_per_height;
            const double along = dot(shift, expected) / dot(expected, expected);
            share = {std::min(share.least, along), std::max(share.most, along)};
            EXPECT_LT(length(shift - static_cast<float>(along) * expected), 1e-6f) << "the shift is not along the view";
        }
    }
    return share;
}

// Of the floor a wall hides, the share that is indeed never seen.
double occlusion(const Technique& technique) {
    const MapSet maps = baked_maps(wall().field(), height_scale);
    double seen = 0;
    double hidden = 0;
    for (const float zero_level : {0.0f, 0.5f, 1.0f}) {
        for (int i = 0; i < 512; ++i) {
            const SurfaceRay ray = toward_plus_u((static_cast<float>(i) + 0.5f) / 512, zero_level);
            const SurfaceHit hit = trace(technique, maps, ray, default_params(technique)).hit;
            seen += behind_wall(hit.uv.x * Profile::texels - 0.5) ? 1 : 0;
            hidden += behind_wall(ray.uv.x * Profile::texels - 0.5) ? 1 : 0;  // what a flat picture shows
        }
    }
    return 1 - seen / hidden;
}

// Of the floor in the wall's shadow, the share found dark, less the share found dark of floor and wall in the light.
double shadow(const Technique& technique) {
    const Profile profile = wall();
    const MapSet maps = baked_maps(profile.field(), height_scale);
    double dark[2] = {0, 0};
    double points[2] = {0, 0};
    for (int i = 0; i < 512; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / 512;
        const double x = u * Profile::texels - 0.5;
        const double height = profile.height(x);
        const bool top = height > 0.8999;
        const bool floor = height < 0.1001;
        // The wall's sides and the shadow's border are left out.
        if (!behind_wall(x) && !top && (!floor || behind_wall(x + 2.5) || behind_wall(x - 2.5))) continue;
        const SurfaceRay view = toward_plus_u(u, 1.0f);
        const SurfaceRay light = glsl::light_ray(view, {.uv = {u, 0.3f}, .height = static_cast<float>(height), .found = true}, view.view, 0.002f);
        const int in_shadow = behind_wall(x) ? 1 : 0;
        points[in_shadow] += 1;
        dark[in_shadow] += trace(technique, maps, light, default_params(technique)).hit.found ? 1 : 0;
    }
    return dark[1] / points[1] - dark[0] / points[0];
}

// Of the rays that pass beyond the chart's border inside the slab, the share that find no surface there.
double silhouette(const Technique& technique) {
    const MapSet maps = baked_maps(wall().field(), height_scale);
    int beyond = 0;
    int missing = 0;
    for (int i = 0; i < 256; ++i) {
        const SurfaceRay ray = toward_plus_u(static_cast<float>(i) / 256 * 0.2f, 1.0f);
        const ReferenceHit hit = truth(maps.height, ray);
        if (hit.uv.x >= 0) continue;
        ++beyond;
        missing += trace(technique, maps, ray, default_params(technique)).hit.found ? 0 : 1;
    }
    return missing / static_cast<double>(beyond);
}

// Nothing lies between "there" and "not there": a technique in the gap needs a better scene or a better claim.
void expect_effect(double measured, bool claimed, double at_least, double at_most_without) {
    if (claimed) {
        EXPECT_GE(measured, at_least) << "claimed, and measured absent";
    } else {
        EXPECT_LE(measured, at_most_without) << "not claimed, and measured present";
    }
}

TEST_P(Effects, motion_parallax) {
    const Range share = parallax(technique());
    RecordProperty("least_share_of_shift", std::to_string(share.least));
    if (technique().effects.motion_parallax) {
        // A damped shift is parallax; a shift the wrong way, or far more than there is, is not.
        EXPECT_GE(share.least, 0.5);
        EXPECT_LE(share.most, 1.05);
    } else {
        EXPECT_EQ(share.least, 0);
        EXPECT_EQ(share.most, 0);
    }
}

TEST_P(Effects, self_occlusion) {
    const double measured = occlusion(technique());
    RecordProperty("hidden", std::to_string(measured));
    // A shift can hide some of it by chance: plain parallax covers 0.47, bisection alone 0.5. A search that hides, hides it all.
    expect_effect(measured, technique().effects.self_occlusion, 0.98, 0.55);
}

TEST_P(Effects, self_shadow) {
    const double measured = shadow(technique());
    RecordProperty("dark", std::to_string(measured));
    // Bisection alone finds the wall from 0.58 of its shadow; every other search from all of it.
    expect_effect(measured, technique().effects.self_shadow, 0.5, 0);
}

TEST_P(Effects, silhouette) { expect_effect(silhouette(technique()), technique().effects.silhouette, 0.98, 0); }

FOR_EVERY_TECHNIQUE(Effects);

}  // namespace
}  // namespace relievo::contract
