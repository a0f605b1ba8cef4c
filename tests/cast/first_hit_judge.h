// Judges a float caster's hits by the reference. Both are given the same float ray, which the reference reads in double. Hits that
// disagree by more than half a texel along the ray are decided in double: a *tangency* where float rounding explains it, else real.
#pragma once

#include "cast/height_field_caster.h"
#include "reference/cast.h"
#include "reference/cell_walk.h"

#include <algorithm>
#include <cmath>

namespace relievo {

struct Verdicts {
    long rays = 0;
    long late = 0;  // more than half a texel behind the true first hit, or not found, without an excuse
    long early = 0;
    long tangent = 0;            // late or early by no more than rounding
    double worst_height = 0;     // of the hits that agree
    double worst_uv_texels = 0;  // of all: the hit off its own ray
    double worst_excused = 0;    // in units of the bound
    Verdicts& operator+=(const Verdicts& o) {
        rays += o.rays, late += o.late, early += o.early, tangent += o.tangent;
        worst_height = std::max(worst_height, o.worst_height), worst_excused = std::max(worst_excused, o.worst_excused);
        worst_uv_texels = std::max(worst_uv_texels, o.worst_uv_texels);
        return *this;
    }
};

inline ReferenceRay in_double(const CastRay& r) {
    return {.uv = Vec2d(r.uv),
            .uv_per_height = Vec2d(r.uv_per_height),
            .zero_level = r.zero_level,
            .z_start = r.z_start,
            .z_end = r.z_end};
}

// Most penetration (field minus ray) between two heights, in units of what float can move field against ray in a cell, u = 2^-24:
// 16 u of height (start, heights, their differences, four sums, the discriminant) and, through the cell's slopes, 24 u cells of
// position (starts within 16 cells of a bundle's corner: 16 u; in the cell 8 u). Positions do not grow with the way.
inline double deepest_in_bounds(const HeightField& field, const ReferenceRay& ray, double z_from, double z_to) {
    constexpr double u = 0x1p-24;
    const Vec2d size{static_cast<double>(field.width()), static_cast<double>(field.height())};
    const Vec2d start = (ray.uv + (z_from - ray.zero_level) * ray.uv_per_height) * size - Vec2d{0.5, 0.5};
    CellWalk walk(field, start, -(ray.uv_per_height * size));
    double worst = -1e9;
    for (;; walk.advance()) {
        const CellGap g = walk.gap(z_from - walk.entered(), -1);
        const double limit = std::min(walk.leaves(), z_from - z_to) - walk.entered();
        double gap = std::max(g.gap, g.at(limit));
        const double vertex = -g.slope / (2 * g.bend);
        if (g.bend < 0 && vertex > 0 && vertex < limit) gap = std::max(gap, g.at(vertex));
        const Vec2i c = walk.cell();
        const auto h = field.cell(c.x, c.y);
        const double slope =
            std::max(std::abs(h[1] - h[0]), std::abs(h[3] - h[2])) + std::max(std::abs(h[2] - h[0]), std::abs(h[3] - h[1]));
        worst = std::max(worst, gap / (16 * u + 24 * u * slope));
        if (walk.leaves() >= z_from - z_to) return worst;
    }
}

inline void judge(const HeightField& field, const CastRay& ray, const ReferenceHit& truth, const CastHit& hit, Verdicts& v) {
    const ReferenceRay same = in_double(ray);
    const Vec2d size{static_cast<double>(field.width()), static_cast<double>(field.height())};
    const double speed = std::max(length(same.uv_per_height * size), 1e-9);
    const double z = hit.height;
    ++v.rays;
    const Vec2d on_ray = same.uv + (z - same.zero_level) * same.uv_per_height;
    v.worst_uv_texels = std::max(v.worst_uv_texels, length((Vec2d(hit.uv) - on_ray) * size));
    const double true_z = truth.found ? truth.height : same.z_end;
    const double behind = (true_z - z) * speed;
    if (truth.found && (!hit.found || behind > 0.5)) {
        const double e = deepest_in_bounds(field, same, true_z, std::max(z, same.z_end));
        e <= 1 ? ++v.tangent : ++v.late;
        if (e <= 1) v.worst_excused = std::max(v.worst_excused, e);
    } else if (behind < -0.5 || (hit.found && !truth.found)) {
        const double e =
            deepest_in_bounds(field, same, std::min(same.z_start, z + 0.25 / speed), std::max(z - 0.25 / speed, same.z_end));
        e >= -1 ? ++v.tangent : ++v.early;
        if (e >= -1) v.worst_excused = std::max(v.worst_excused, -e);
    } else if (hit.found) {
        v.worst_height = std::max(v.worst_height, std::abs(truth.height - z));
    }
}

}  // namespace relievo
