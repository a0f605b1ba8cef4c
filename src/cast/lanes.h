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

// Where rays start along an axis, (uv + uv_per_height * way) * cells - 1/2, and how they go on, to more digits than a float has.
#if HWY_NATIVE_FMA
// Sums and products with their rounding errors (Knuth 1969, section 4.2.2; Dekker 1971): half the work of double, of which a vector
// holds half as many.
HWY_INLINE void set_axis(F uv, F uv_per_height, F way, int size, LaneAxis& out) {
    const Floats d;
    const Ints di;
    const F cells = hn::Set(d, static_cast<float>(size)), zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const F moved = hn::Mul(way, uv_per_height), moved_rest = hn::MulSub(way, uv_per_height, moved);
    const F sum = hn::Add(uv, moved), back = hn::Sub(sum, uv);
    const F sum_rest = hn::Add(hn::Add(hn::Sub(uv, hn::Sub(sum, back)), hn::Sub(moved, back)), moved_rest);
    const F x = hn::Mul(sum, cells), x_rest = hn::MulAdd(sum_rest, cells, hn::MulSub(sum, cells, x));
    // The cell from x alone may be one off, by the rest.
    const F about = hn::Floor(hn::Sub(x, hn::Set(d, 0.5f)));
    const F beyond = hn::Add(hn::Sub(hn::Sub(x, about), hn::Set(d, 0.5f)), x_rest), off = hn::Floor(beyond);
    const F cell = hn::Add(about, off);
    const F periods = hn::Floor(hn::Mul(cell, hn::Set(d, 1.0f / static_cast<float>(size))));
    F in = hn::NegMulAdd(periods, cells, cell);
    in = hn::Add(in, hn::IfThenElseZero(hn::Lt(in, zero), cells));
    in = hn::Sub(in, hn::IfThenElseZero(hn::Ge(in, cells), cells));
    // Clamped because of rounding; what is no number becomes one.
    hn::Store(hn::ConvertTo(di, hn::Min(hn::Max(in, zero), hn::Sub(cells, one))), di, out.cell);
    hn::Store(hn::Min(hn::Max(hn::Sub(beyond, off), zero), one), d, out.start);
    const F slope = hn::Neg(uv_per_height), speed = hn::Mul(slope, cells), pace = hn::Abs(speed);
    const FMask moves = hn::And(hn::Gt(pace, hn::Set(d, standstill)), hn::Lt(pace, hn::Set(d, never)));
    hn::Store(hn::IfThenElseZero(moves, speed), d, out.speed);
    hn::Store(hn::IfThenElseZero(moves, hn::MulSub(slope, cells, speed)), d, out.rest);
    hn::Store(hn::IfThenElse(moves, hn::Div(one, speed), hn::Set(d, never)), d, out.inverse);
}
#else
// Plain loops over the lanes, for the compiler to make vectors of.
HWY_INLINE void set_axis(F uvs, F uvs_per_height, F ways, int cells, LaneAxis& out) {
    const Floats d;
    alignas(64) float uv[lane_count], uv_per_height[lane_count], way[lane_count];
    hn::Store(uvs, d, uv), hn::Store(uvs_per_height, d, uv_per_height), hn::Store(ways, d, way);
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
#endif

// Added to a whole number between -2^22 and 2^22 it leaves that number in the last bits: a conversion in one operation, where
// ConvertTo takes five, as it looks after what is too large.
constexpr float to_bits = 12582912.0f;  // 1.5 * 2^23
constexpr std::int32_t to_bits_as_int = 0x4b400000;
// The whole number v, plus to_bits_as_int.
HWY_INLINE I whole_bits(F v) { return hn::BitCast(Ints(), hn::Add(v, hn::Set(Floats(), to_bits))); }
HWY_INLINE I whole(F v) { return hn::Sub(whole_bits(v), hn::Set(Ints(), to_bits_as_int)); }

// The rays as vectors: one per field of CastRay.
struct RayVectors {
    F u, v, du, dv, zero_level, z_start, z_end;
};

HWY_INLINE void set_up(const CastGrid& grid, const RayVectors& rays, Lanes& out) {
    const Floats d;
    const Ints di;
    const F way = hn::Sub(rays.z_start, rays.zero_level), descent = hn::Sub(rays.z_start, rays.z_end);
    set_axis(rays.u, rays.du, way, grid.width, out.x);
    set_axis(rays.v, rays.dv, way, grid.height, out.y);
    const F from = hn::Add(hn::Add(hn::Abs(rays.u), hn::Abs(rays.v)), hn::Abs(way)),
            slope = hn::Add(hn::Abs(rays.du), hn::Abs(rays.dv));
    const F texels = hn::Mul(hn::Add(hn::Abs(hn::Load(d, out.x.speed)), hn::Abs(hn::Load(d, out.y.speed))), descent);
    const F far = hn::Set(d, never);
    const FMask valid = hn::And(hn::And(hn::Lt(from, far), hn::Lt(slope, far)),
                                hn::And(hn::Le(texels, hn::Set(d, longest_way_texels)), hn::Ge(descent, hn::Zero(d))));
    // What is no ray becomes one that is short and far above.
    hn::Store(hn::IfThenElse(valid, rays.z_start, hn::Set(d, 2.0f)), d, out.z_start);
    hn::Store(hn::IfThenElseZero(valid, descent), d, out.descent_end);
    hn::Store(hn::IfThenElseZero(hn::RebindMask(di, valid), hn::Set(di, 1)), di, out.valid);
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
