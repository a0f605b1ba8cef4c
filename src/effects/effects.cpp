#include "effects/effects.h"

#include "maps/map_kinds.h"
#include "reference/cast.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
namespace relievo::glsl {
namespace {
#include "surface/ray_entry.glsl"
}
}  // namespace relievo::glsl
#pragma GCC diagnostic pop

namespace relievo {

namespace {

using glsl::SurfaceHit;
using glsl::SurfaceRay;

constexpr float height_scale = 0.1f;
constexpr double elevation_deg = 25;
constexpr float finest = -16.0f;  // a footprint finer than any texel

// A wall thicker than any ray is long, between floors wider than any shadow: along u, the same at every v.
constexpr int wall_texels = 64;
constexpr double wall_low = 0.1, wall_high = 0.9;
constexpr int wall_foot = 24, wall_top = 25, wall_edge = 45, wall_back = 46;  // texels between which the height goes up and down

double wall_height(double texel) {
    const double x = texel - wall_texels * std::floor(texel / wall_texels);
    const double up = std::clamp(x - wall_foot, 0.0, static_cast<double>(wall_top - wall_foot));
    const double down = std::clamp(x - wall_edge, 0.0, static_cast<double>(wall_back - wall_edge));
    return wall_low + (wall_high - wall_low) * (up - down);
}

HeightField wall() {
    HeightField field(wall_texels, 8);
    for (int j = 0; j < field.height(); ++j)
        for (int i = 0; i < wall_texels; ++i) field.texels(i, j) = static_cast<float>(wall_height(i));
    return field;
}

// From an eye or a lamp on the +u side, the floor this far behind the wall cannot be reached: texels, a texel clear of its ends.
bool behind_wall(double texel) {
    const double reach = (wall_high - wall_low) * static_cast<double>(height_scale) / std::tan(elevation_deg * std::numbers::pi / 180) * wall_texels;
    const double x = texel - wall_texels * std::floor(texel / wall_texels);
    return x > wall_top - reach + 1 && x < wall_foot - 1;
}

// The maps that this technique reads, at one height_scale.
MapSet maps_for(const Technique& technique, const HeightField& field) {
    MapSet maps;
    maps.height = field;
    for (const MapKind& kind : map_kinds())
        if (kind.bake != nullptr && technique.maps.contains(kind.map)) kind.bake(maps, {.height_scale = height_scale, .threads = 1, .progress = {}});
    return maps;
}

// Unit vector from the surface to the eye.
glsl::vec3 view_from(double elevation, double azimuth) {
    const double e = elevation * std::numbers::pi / 180, a = azimuth * std::numbers::pi / 180;
    return {static_cast<float>(std::cos(e) * std::cos(a)), static_cast<float>(std::cos(e) * std::sin(a)), static_cast<float>(std::sin(e))};
}

SurfaceRay toward_plus_u(float u, float zero_level) { return glsl::view_ray({u, 0.3f}, view_from(elevation_deg, 0), height_scale, zero_level, finest); }

SurfaceHit search(const Technique& technique, const MapSet& maps, const SurfaceRay& ray) {
    glsl::bound_maps = declared_maps(technique, maps);
    const SurfaceHit hit = technique.heightfield(ray, default_params(technique));
    glsl::bound_maps = {};
    return hit;
}

constexpr EffectKind table[] = {
    {
        .id = "motion_parallax",
        .title = "Motion parallax",
        .scene = "plateaux above and below the polygon, seen from four sides",
        .number = "share of the true shift, at its worst",
        // A damped shift is parallax; a shift the wrong way is not.
        .present_from = 0.5,
        .absent_to = 0,
        .claim = &Effects::motion_parallax,
        .measure = [](const Technique& t) { return measured_parallax(t).least; },
    },
    {
        .id = "self_occlusion",
        .title = "Self-occlusion",
        .scene = "the floor behind a wall, which no eye on the other side can see",
        .number = "share of that floor that is never shown",
        // A shift can hide some of it by chance: plain parallax covers 0.47, bisection alone 0.5. A search that hides, hides it all.
        .present_from = 0.98,
        .absent_to = 0.55,
        .claim = &Effects::self_occlusion,
        .measure = measured_occlusion,
    },
    {
        .id = "self_shadow",
        .title = "Self-shadow",
        .scene = "the same floor, from a lamp in the place of the eye",
        .number = "share of the shadow found dark, less that of the light",
        // Bisection alone finds the wall from 0.58 of its shadow; every other search from all of it.
        .present_from = 0.5,
        .absent_to = 0,
        .claim = &Effects::self_shadow,
        .measure = measured_shadow,
    },
    {
        .id = "silhouette",
        .title = "Silhouettes",
        .scene = "rays that leave the chart over its border, inside the slab",
        .number = "share that finds no surface out there",
        .present_from = 0.98,
        .absent_to = 0,
        .claim = &Effects::silhouette,
        .measure = measured_silhouette,
    },
};
static_assert(std::size(table) == effect_count);

}  // namespace

Parallax measured_parallax(const Technique& technique) {
    Parallax share{1e9, -1e9, 0};
    for (const float height : {0.2f, 0.8f}) {
        const MapSet maps = maps_for(technique, HeightField(8, 8, height));
        for (const double azimuth : {0.0, 77.0, 180.0, 260.0}) {
            const SurfaceRay ray = glsl::view_ray({0.3f, 0.6f}, view_from(60, azimuth), height_scale, 0.5f, finest);
            const glsl::vec2 shift = search(technique, maps, ray).uv - ray.uv;
            const glsl::vec2 expected = (height - 0.5f) * ray.uv_per_height;
            const double along = dot(shift, expected) / dot(expected, expected);
            share.least = std::min(share.least, along);
            share.most = std::max(share.most, along);
            share.sideways = std::max(share.sideways, static_cast<double>(length(shift - static_cast<float>(along) * expected)));
        }
    }
    return share;
}

double measured_occlusion(const Technique& technique) {
    const MapSet maps = maps_for(technique, wall());
    double seen = 0;
    double hidden = 0;
    for (const float zero_level : {0.0f, 0.5f, 1.0f}) {
        for (int i = 0; i < 512; ++i) {
            const SurfaceRay ray = toward_plus_u((static_cast<float>(i) + 0.5f) / 512, zero_level);
            const SurfaceHit hit = search(technique, maps, ray);
            seen += behind_wall(hit.uv.x * wall_texels - 0.5) ? 1 : 0;
            hidden += behind_wall(ray.uv.x * wall_texels - 0.5) ? 1 : 0;  // what a flat picture shows
        }
    }
    return 1 - seen / hidden;
}

double measured_shadow(const Technique& technique) {
    const MapSet maps = maps_for(technique, wall());
    double dark[2] = {0, 0};
    double points[2] = {0, 0};
    for (int i = 0; i < 512; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / 512;
        const double x = u * wall_texels - 0.5;
        const double height = wall_height(x);
        const bool top = height > wall_high - 1e-4;
        const bool floor = height < wall_low + 1e-4;
        // The wall's sides and the shadow's border are left out.
        if (!behind_wall(x) && !top && (!floor || behind_wall(x + 2.5) || behind_wall(x - 2.5))) continue;
        const SurfaceRay view = toward_plus_u(u, 1.0f);
        const SurfaceRay light = glsl::light_ray(view, {.uv = {u, 0.3f}, .height = static_cast<float>(height), .found = true}, view.view, 0.002f);
        const int in_shadow = behind_wall(x) ? 1 : 0;
        points[in_shadow] += 1;
        dark[in_shadow] += search(technique, maps, light).found ? 1 : 0;
    }
    return dark[1] / points[1] - dark[0] / points[0];
}

double measured_silhouette(const Technique& technique) {
    const MapSet maps = maps_for(technique, wall());
    int beyond = 0;
    int missing = 0;
    for (int i = 0; i < 256; ++i) {
        const SurfaceRay ray = toward_plus_u(static_cast<float>(i) / 256 * 0.2f, 1.0f);
        const ReferenceHit hit = reference_cast(maps.height, {.uv = Vec2d(ray.uv), .uv_per_height = Vec2d(ray.uv_per_height), .zero_level = 1});
        if (hit.uv.x >= 0) continue;
        ++beyond;
        missing += search(technique, maps, ray).found ? 0 : 1;
    }
    return missing / static_cast<double>(beyond);
}

std::span<const EffectKind> effect_kinds() { return table; }

}  // namespace relievo
