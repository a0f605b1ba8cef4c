// Rays of a vector that go the same way at about the same place, and what holds for all of them.
//
// p is the axis along, the one they cross fastest; q the other. a counts cells along the way from the first block's near wall,
// whichever sign p has.
#if defined(RELIEVO_CAST_BUNDLE_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELIEVO_CAST_BUNDLE_H
#undef RELIEVO_CAST_BUNDLE_H
#else
#define RELIEVO_CAST_BUNDLE_H
#endif

#include "cast/lanes.h"

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace relievo {
namespace HWY_NAMESPACE {

HWY_INLINE float least(F v) { return hn::GetLane(hn::MinOfLanes(Floats(), v)); }
HWY_INLINE float largest(F v) { return hn::GetLane(hn::MaxOfLanes(Floats(), v)); }

// A wider bundle (cells between its outermost lanes) is walked lane by lane: its slices would be full of cells few lanes cross.
constexpr std::int32_t widest_bundle = 16;
// Blocks across the widest bundle the setup lets pass: its spread and what it leans by in a slice.
constexpr std::size_t most_rows = 24;

struct Bundle {
    bool along_x;   // p is x
    bool forward;   // p grows
    bool sideways;  // q grows, or stays
    // Bounds over all lanes: no lane is lower than max(floor, roof - descent_slope * a) before it has come `a` far, and
    // side_low + lean_low * a <= q <= side_high + lean_high * a.
    float floor, roof, descent_slope;
    float side_low, lean_low, side_high, lean_high;
    float a_end;                      // no lane gets further
    std::int32_t rows;                // of blocks that a slice can touch
    std::int32_t p_blocks, q_blocks;  // in a period
    std::int32_t block_p, block_q;    // the first block; may lie outside the period
    // Where each lane starts: whole cells from the first block's near wall and least q, and the rest.
    F cells_p, cells_q, inside_p, inside_q;

    // The same for the 16 cells of a block that begins at a, q. Lanes cross a cell where cell_low <= q - lean_low * a and
    // q - lean_high * a <= cell_high; in it none is lower than max(floor, cell_roof - descent_slope * a).
    static constexpr std::size_t vectors = block_cells / lane_count;
    F cell_low[vectors], cell_high[vectors], cell_roof[vectors];
};

// False where the lanes are no bundle.
HWY_INLINE bool make_bundle(const CastGrid& grid, const Lanes& lanes, Bundle& out) {
    const Floats d;
    const Ints di;
    if (grid.width % block_side != 0 || grid.height % block_side != 0 || grid.levels <= block_level) return false;

    const F speed_x = hn::Load(d, lanes.x.speed), speed_y = hn::Load(d, lanes.y.speed);
    const float least_x = least(speed_x), largest_x = largest(speed_x), least_y = least(speed_y), largest_y = largest(speed_y);
    const float slowest_x = least_x > 0 ? least_x : largest_x < 0 ? -largest_x : 0.0f;
    const float slowest_y = least_y > 0 ? least_y : largest_y < 0 ? -largest_y : 0.0f;
    out.along_x = slowest_x >= slowest_y;
    if (!((out.along_x ? slowest_x : slowest_y) > 1.0f)) return false;
    if ((out.along_x ? least_y : least_x) < 0 && (out.along_x ? largest_y : largest_x) > 0) return false;
    out.forward = (out.along_x ? least_x : least_y) > 0;
    out.sideways = (out.along_x ? least_y : least_x) >= 0;
    const int p_size = out.along_x ? grid.width : grid.height, q_size = out.along_x ? grid.height : grid.width;

    // Lanes on both sides of the period's end are brought to one side.
    const LaneAxis& p = out.along_x ? lanes.x : lanes.y;
    const LaneAxis& q = out.along_x ? lanes.y : lanes.x;
    const auto from_first = [&](const std::int32_t* cells, int size) {
        const I v = hn::Sub(hn::Load(di, cells), hn::Set(di, cells[0]));
        const I half = hn::Set(di, size / 2), whole = hn::Set(di, size);
        const I down = hn::IfThenElseZero(hn::Gt(v, half), whole), up = hn::IfThenElseZero(hn::Lt(v, hn::Neg(half)), whole);
        return hn::ConvertTo(d, hn::Add(hn::Sub(v, down), up));
    };
    const F from_p = from_first(p.cell, p_size), from_q = from_first(q.cell, q_size);
    const std::int32_t low_p = p.cell[0] + static_cast<std::int32_t>(least(from_p));
    const std::int32_t high_p = p.cell[0] + static_cast<std::int32_t>(largest(from_p));
    const std::int32_t low_q = q.cell[0] + static_cast<std::int32_t>(least(from_q));
    if (high_p - low_p > widest_bundle) return false;
    out.block_p = (out.forward ? low_p : high_p) >> block_level;
    out.block_q = low_q >> block_level;
    out.p_blocks = p_size >> block_level;
    out.q_blocks = q_size >> block_level;
    out.cells_p =
        hn::Add(from_p, hn::Set(d, static_cast<float>(p.cell[0] - ((out.block_p + (out.forward ? 0 : 1)) << block_level))));
    out.cells_q = hn::Add(from_q, hn::Set(d, static_cast<float>(q.cell[0] - (out.block_q << block_level))));
    out.inside_p = hn::Load(d, p.start);
    out.inside_q = hn::Load(d, q.start);

    const F z_start = hn::Load(d, lanes.z_start), descent_end = hn::Load(d, lanes.descent_end);
    const F along = hn::Add(out.cells_p, out.inside_p), a_start = out.forward ? along : hn::Neg(along);
    const F pace = hn::Abs(hn::Load(d, p.inverse));
    const F lean = hn::Mul(hn::Load(d, q.speed), pace);
    const F side = hn::NegMulAdd(lean, a_start, hn::Add(out.cells_q, out.inside_q));
    // Each bound is widened by far more than its rounding.
    out.descent_slope = largest(pace) * 1.000001f;
    const float descent_base = largest(hn::Neg(hn::Mul(a_start, pace))) + 1e-6f;
    out.lean_low = least(lean);
    out.lean_high = largest(lean);
    out.side_low = least(side) - 0.002f;
    out.side_high = largest(side) + 0.002f;
    out.roof = least(z_start) - descent_base - skip_margin;
    out.floor = least(hn::Sub(z_start, descent_end)) - skip_margin;
    out.a_end = largest(hn::MulAdd(hn::Abs(out.along_x ? speed_x : speed_y), descent_end, a_start));
    const float leans =
        std::max(std::fabs(out.lean_low), std::fabs(out.lean_high)) * block_side + (out.lean_high - out.lean_low) * out.a_end;
    out.rows = static_cast<std::int32_t>((out.side_high - out.side_low + leans) * (1.0f / block_side)) + 2;
    const std::int32_t u_bits = out.along_x ? 0 : block_level, v_bits = block_level - u_bits;
    for (std::size_t c = 0; c < Bundle::vectors; ++c) {
        const I cell = hn::Add(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(c * lane_count)));
        const I three = hn::Set(di, block_side - 1);
        const F u = hn::ConvertTo(d, hn::And(hn::ShiftRightSame(cell, u_bits), three));
        const F v = hn::ConvertTo(d, hn::And(hn::ShiftRightSame(cell, v_bits), three));
        const F near = hn::MulAdd(u, hn::Set(d, out.forward ? 1.0f : -1.0f), hn::Set(d, out.forward ? 0.0f : block_side - 1.0f));
        out.cell_low[c] =
            hn::Sub(hn::MulAdd(near, hn::Set(d, out.lean_low), hn::Set(d, out.side_low + std::min(out.lean_low, 0.0f) - 1)), v);
        out.cell_high[c] =
            hn::Sub(hn::MulAdd(near, hn::Set(d, out.lean_high), hn::Set(d, out.side_high + std::max(out.lean_high, 0.0f))), v);
        out.cell_roof[c] = hn::NegMulAdd(near, hn::Set(d, out.descent_slope), hn::Set(d, out.roof - out.descent_slope));
    }
    // Beyond 2^13 cells the bounds' rounding outgrows their widening.
    return out.side_high - out.side_low < 3 * widest_bundle && (out.lean_high - out.lean_low) * out.a_end < widest_bundle &&
           out.a_end < 8192.0f && out.rows <= static_cast<std::int32_t>(most_rows);
}

}  // namespace HWY_NAMESPACE
}  // namespace relievo
HWY_AFTER_NAMESPACE();

#endif  // per target
