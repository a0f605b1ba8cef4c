// A vector of rays, each relative to the cell it starts in. Included once per instruction set (see cast_kernel.cpp).
#if defined(RELIEVO_CAST_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELIEVO_CAST_LANES_H
#undef RELIEVO_CAST_LANES_H
#else
#define RELIEVO_CAST_LANES_H
#endif

#include "cast/cast_grid.h"

#include <hwy/highway.h>

#include <cmath>
#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace relievo {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Ints = hn::ScalableTag<std::int32_t>;
using F = hn::Vec<Floats>;
using I = hn::Vec<Ints>;
using FMask = hn::Mask<Floats>;
using IMask = hn::Mask<Ints>;

constexpr std::size_t lane_count = hn::MaxLanes(Floats());

// Along one axis, in cells.
struct alignas(64) LaneAxis {
    float start[lane_count];        // in the first cell, [0, 1]
    float speed[lane_count];        // cells per unit of descent
    float rest[lane_count];         // what the float speed lacks of the true one
    float inverse[lane_count];      // 1 / speed; `never` where that is 0
    std::int32_t cell[lane_count];  // the first, in one period
};

struct alignas(64) Lanes {
    LaneAxis x, y;
    float z_start[lane_count];
    float descent_end[lane_count];
    std::int32_t valid[lane_count];
};

// What a walk found: the descent at which each lane enters the cell of its hit, or at which it ended, and the gap (field minus ray)
// from there on, gap + s (slope + s bend), whose first root is the hit; no lower than 0 where the entry is.
struct LaneHits {
    F begin, gap, slope, bend;
    FMask found;
};

// Slower than this a ray leaves no cell.
constexpr float standstill = 1e-18f;
constexpr float never = 1e30f;
// Skips are biased by a few units in the last place of a height near 1: a node within that of the ray is opened.
constexpr float skip_margin = 4e-7f;

// Plain loops over the lanes, for the compiler to make vectors of: they are in double, of which a vector holds fewer.
HWY_INLINE void set_axis(const float* uv, const float* uv_per_height, const float* way, float cells, LaneAxis& out) {
    const double size = cells, periods = 1 / size;
    for (std::size_t k = 0; k < lane_count; ++k) {
        const double x = (uv[k] + static_cast<double>(way[k]) * uv_per_height[k]) * size - 0.5;
        const double wrapped = x - std::floor(x * periods) * size;
        // Clamped because of rounding, and written so that what is no number becomes one.
        double c = std::floor(wrapped);
        c = c >= 0 ? c : 0;
        c = c <= size - 1 ? c : size - 1;
        out.cell[k] = static_cast<std::int32_t>(c);
        float inside = static_cast<float>(wrapped - c);
        inside = inside >= 0 ? inside : 0;
        out.start[k] = inside <= 1 ? inside : 1;
        const double exact = -static_cast<double>(uv_per_height[k]) * size;
        const float rounded = static_cast<float>(exact);
        const bool moves = std::fabs(rounded) > standstill && std::fabs(rounded) < never;
        out.speed[k] = moves ? rounded : 0.0f;
        out.rest[k] = moves ? static_cast<float>(exact - rounded) : 0.0f;
        const float inverse = 1.0f / (moves ? rounded : 1.0f);
        out.inverse[k] = moves ? inverse : never;
    }
}

// The rays as vectors: one per field of CastRay.
struct RayVectors {
    F u, v, du, dv, zero_level, z_start, z_end;
};

static_assert(sizeof(CastRay) == 7 * sizeof(float));

// `lane_count` rays one behind the other.
HWY_INLINE RayVectors load_rays(const CastRay* rays) {
    const Floats d;
    const Ints di;
    const I index = hn::Mul(hn::Iota(di, 0), hn::Set(di, 7));
    const float* const base = &rays->uv.x;
    return {hn::GatherIndex(d, base, index),     hn::GatherIndex(d, base + 1, index), hn::GatherIndex(d, base + 2, index),
            hn::GatherIndex(d, base + 3, index), hn::GatherIndex(d, base + 4, index), hn::GatherIndex(d, base + 5, index),
            hn::GatherIndex(d, base + 6, index)};
}

HWY_INLINE void set_up(const CastGrid& grid, const RayVectors& rays, Lanes& out) {
    const Floats d;
    alignas(64) float u[lane_count], v[lane_count], du[lane_count], dv[lane_count], way[lane_count];
    hn::Store(rays.u, d, u), hn::Store(rays.v, d, v), hn::Store(rays.du, d, du), hn::Store(rays.dv, d, dv);
    hn::Store(hn::Sub(rays.z_start, rays.zero_level), d, way);
    hn::Store(rays.z_start, d, out.z_start);
    hn::Store(hn::Sub(rays.z_start, rays.z_end), d, out.descent_end);
    set_axis(u, du, way, static_cast<float>(grid.width), out.x);
    set_axis(v, dv, way, static_cast<float>(grid.height), out.y);
    for (std::size_t k = 0; k < lane_count; ++k) {
        const float from = std::fabs(u[k]) + std::fabs(v[k]) + std::fabs(way[k]), slope = std::fabs(du[k]) + std::fabs(dv[k]);
        const float texels = (std::fabs(out.x.speed[k]) + std::fabs(out.y.speed[k])) * out.descent_end[k];
        const bool valid = from < never && slope < never && texels <= longest_way_texels && out.descent_end[k] >= 0;
        // What is no ray becomes one that is short and far above.
        out.z_start[k] = valid ? out.z_start[k] : 2;
        out.descent_end[k] = valid ? out.descent_end[k] : 0;
        out.valid[k] = valid;
    }
}

// Position in a cell, start + speed * descent - cell, whose terms may be a million times its value.
HWY_INLINE F precise_offset(F speed, F rest, F descent, F cell, F start) {
#if HWY_NATIVE_FMA
    return hn::Add(hn::MulSub(speed, descent, cell), hn::MulAdd(rest, descent, start));
#else
    const Floats d;
    alignas(64) float a[lane_count], b[lane_count], c[lane_count], e[lane_count], f[lane_count];
    hn::Store(speed, d, a), hn::Store(rest, d, b), hn::Store(descent, d, c), hn::Store(cell, d, e), hn::Store(start, d, f);
    for (std::size_t k = 0; k < lane_count; ++k) a[k] = static_cast<float>((static_cast<double>(a[k]) + b[k]) * c[k] - e[k] + f[k]);
    return hn::Load(d, a);
#endif
}

// Heights of nodes, gathered as aligned pairs: the address of `nodes` is a multiple of 4.
HWY_INLINE F node_top(const std::uint16_t* nodes, I index) {
    const Floats d;
    const Ints di;
    const I pair = hn::GatherIndex(di, reinterpret_cast<const std::int32_t*>(nodes), hn::ShiftRight<1>(index));
    const I word = hn::And(hn::Shr(pair, hn::ShiftLeft<4>(hn::And(index, hn::Set(di, 1)))), hn::Set(di, 0xffff));
    return hn::Mul(hn::ConvertTo(d, word), hn::Set(d, node_unit));
}

// Where a field minus a ray that is `gap` now, changing by slope + 2 bend s, first reaches 0 from below; nothing like a number
// where it does not.
struct Roots {
    F first, second;
};
HWY_INLINE Roots roots_of(F gap, F slope, F bend, F square) {
    const Floats d;
    const F q = hn::Mul(hn::Set(d, -0.5f), hn::Add(slope, hn::CopySign(hn::Sqrt(hn::Max(square, hn::Zero(d))), slope)));
    return {hn::Div(q, bend), hn::Div(gap, q)};
}

}  // namespace HWY_NAMESPACE
}  // namespace relievo
HWY_AFTER_NAMESPACE();

#endif  // per target
