// One technique on one ray on the CPU, allowed to read the maps its row declares and no other.
#pragma once

#include "contract/baked_maps.h"
#include "reference/cast.h"
#include "techniques/catalogue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <ostream>
#include <random>
#include <string>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
namespace relievo::glsl {
namespace {
#include "surface/ray_entry.glsl"
}
}  // namespace relievo::glsl
#pragma GCC diagnostic pop

namespace relievo {

inline void PrintTo(const Technique* technique, std::ostream* out) { *out << technique->id; }

}  // namespace relievo

namespace relievo::contract {

using glsl::SurfaceHit;
using glsl::SurfaceRay;

// Every contract test is run once per row of the catalogue; its name in ctest ends with the technique's id.
class EveryTechnique : public testing::TestWithParam<const Technique*> {
protected:
    const Technique& technique() const { return *GetParam(); }
    MarchParams defaults() const { return default_params(technique()); }
};

inline std::vector<const Technique*> catalogue_rows() {
    std::vector<const Technique*> rows;
    for (const Technique& t : techniques())
        if (t.family == Family::heightfield) rows.push_back(&t);
    return rows;
}

inline std::string row_name(const testing::TestParamInfo<const Technique*>& info) { return std::string(info.param->id); }

// Runs the tests of a fixture derived from EveryTechnique for every row.
#define FOR_EVERY_TECHNIQUE(Fixture) INSTANTIATE_TEST_SUITE_P(catalogue, Fixture, testing::ValuesIn(catalogue_rows()), row_name)

struct Traced {
    SurfaceHit hit;
    int fetches;
};

inline Traced trace(const Technique& technique, const glsl::BoundMaps& bound, const SurfaceRay& ray, const MarchParams& params) {
    glsl::bound_maps = bound;
    glsl::fetch_count = 0;
    const SurfaceHit hit = technique.heightfield(ray, params);
    return {hit, glsl::fetch_count};
}

inline Traced trace(const Technique& technique, const MapSet& maps, const SurfaceRay& ray, const MarchParams& params) {
    return trace(technique, declared_maps(technique, maps), ray, params);
}

// A footprint finer than any texel of the test fields: the declared surface and its finest normals.
inline constexpr float finest = -16.0f;

// Unit vector from the surface to the eye.
inline glsl::vec3 view_from(double elevation_deg, double azimuth_deg) {
    const double e = elevation_deg * std::numbers::pi / 180;
    const double a = azimuth_deg * std::numbers::pi / 180;
    return {static_cast<float>(std::cos(e) * std::cos(a)), static_cast<float>(std::cos(e) * std::sin(a)), static_cast<float>(std::sin(e))};
}

inline ReferenceHit truth(const HeightField& field, const SurfaceRay& ray) {
    return reference_cast(field, {.uv = Vec2d(ray.uv), .uv_per_height = Vec2d(ray.uv_per_height), .zero_level = ray.zero_level,
                                  .z_start = ray.z_start, .z_end = ray.z_end});
}

// Rays of one elevation from all sides, over a whole repeat. The same for every technique.
inline std::vector<SurfaceRay> random_rays(int count, double elevation_deg, float height_scale, float zero_level, unsigned seed) {
    std::mt19937 random(seed);
    const auto unit = [&] { return static_cast<float>(random() >> 8) / 16777216.0f; };
    std::vector<SurfaceRay> rays;
    for (int i = 0; i < count; ++i) {
        const float u = unit();
        const float v = unit();
        rays.push_back(glsl::view_ray({u, v}, view_from(elevation_deg, 360.0 * unit()), height_scale, zero_level, -6.0f));
    }
    return rays;
}

}  // namespace relievo::contract
