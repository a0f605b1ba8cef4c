// Exact first hits of the declared bilinear surface, in double, by a plain walk from cell to cell: no pyramid, no cones and
// nothing in common with the shaders, so that it cannot share their mistakes.
#pragma once

#include "core/frame.h"
#include "core/height_field.h"
#include "core/lighting.h"
#include "core/map_set.h"
#include "core/progress.h"
#include "core/vec.h"

#include <span>

namespace relievo {

// A descending ray in texture space: at height z it stands over uv + (z - zero_level) * uv_per_height; searched from z_start
// down to z_end <= z_start. uv_per_height is height_scale * view.xy / view.z; all finite, start and end within 2e9 texels.
struct ReferenceRay {
    Vec2d uv;
    Vec2d uv_per_height;
    double zero_level = 1;
    double z_start = 1;
    double z_end = 0;
};

struct ReferenceHit {
    bool found = false;
    Vec2d uv;           // not wrapped
    double height = 0;
    Vec2i cell;         // bilinear cell of the hit, not wrapped
};

// The first point at which the field is no lower than the ray. Every field is at least 0 and a ray with z_end = 0 reaches the
// floor, so it always finds a hit. Not found: uv is where the ray ends. The field must not be empty.
ReferenceHit reference_cast(const HeightField& field, const ReferenceRay& ray);

// Whether the straight line from a surface point toward a light (unit, tangent space) meets the surface again before it leaves
// the slab at z = 1: true means hidden. A point whose patch faces away from the light is hidden, so is every point from a light
// at or below the plane; a line that only touches the surface is not. The point must be found, and lie in its cell. `highest`: the
// line is followed up to this height, at most 1.
bool reference_shadow(const HeightField& field, const ReferenceHit& point, Vec3d to_light, double height_scale, double highest = 1);

// How the surface reflects. Blinn-Phong's exponent is four times Phong's; GGX has Smith's masking with correlated heights and Schlick's
// Fresnel from 0.04 or the metal's colour; Gouraud and flat shading are Phong's light at the corners, or on the one best plane, of the
// cells of a grid laid over the relief.
inline constexpr Vec3d sheet_colour{0.02, 0.08, 0.12};

enum class Reflection { phong, blinn_phong, ggx, gouraud, flat };

struct ReferenceSettings {
    float height_scale = 0.05f;
    float zero_level = 1;
    bool shadow = true;   // cast exact shadows from the key light (the first)
    double light_radius_rad = 0;  // of the key light's disc (area_light.h); 0: a point, with hard shadows
    double chart = 0;      // beyond the square [0, chart]^2 of UV there is no surface; 0: it repeats
    Reflection reflection = Reflection::phong;
    double roughness = 0.5;  // of GGX, perceptual
    double metallic = 0;
    double sheet = -1;       // height of an opaque level sheet over the base, of one colour, that hides what is lower; negative: none
    int facets = 64;         // cells along a repeat, for Gouraud and flat shading
    Vec2d uv_at_origin{1, 1};  // texture coordinate of the world's origin: half the quad's periods; places the hit for lights at a distance
    int threads = 0;      // 0: all cores; the result does not depend on it
};

// The true picture. samples[0] are the rays through the pixel centres and fill every plane; colour averages the shaded hits of
// all samples in linear light. Lights are in world space, of which tangent space is a translation here (flat base, t = +x).
// Shading: lighting.h's Phong on colour and normals at the exact hit, filtered bilinearly (colour texels decoded to linear
// first) and between the two levels of the map's chain next to clamp(lod + log2(longer side), 0, levels - 1). No highlight where
// the normal faces away from the light. Pixels off the base hold the background, and so do those whose ray meets no surface on the
// chart (coverage no_hit). Fetches are 0: there are none to compare.
// Throws Error where a map is missing; all samples are of one size.
Frame reference_frame(std::span<const RayField> samples, const MapSet& maps, const Lighting& lighting,
                      const ReferenceSettings& settings, const Progress& progress = {});

}  // namespace relievo
