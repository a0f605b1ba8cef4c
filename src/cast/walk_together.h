// All lanes as one bundle, slice by slice along the axis it crosses fastest
// (coherent grid traversal: Wald, Ize, Kensler, Knoll and Parker 2006, "Ray
// tracing animated scenes using coherent grid traversal"). A slice is a column
// of 4x4 blocks. Blocks and then cells whose tops the bundle does not clear are
// put to all lanes at once with their patch broadcast, so nothing is gathered
// and no lane waits for another. Which cell a lane hits first is decided by
// signs; the roots are solved once, at the end.
//
// p is the axis along, q the other; a counts cells along the way from the first
// block's near wall, whichever sign p has.
#if defined(RELIEVO_CAST_WALK_TOGETHER_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELIEVO_CAST_WALK_TOGETHER_H
#undef RELIEVO_CAST_WALK_TOGETHER_H
#else
#define RELIEVO_CAST_WALK_TOGETHER_H
#endif

#include "cast/lanes.h"

#include <algorithm>
#include <bit>

HWY_BEFORE_NAMESPACE();
namespace relievo {
namespace HWY_NAMESPACE {

HWY_INLINE float least(F v) { return hn::GetLane(hn::MinOfLanes(Floats(), v)); }
HWY_INLINE float largest(F v) { return hn::GetLane(hn::MaxOfLanes(Floats(), v)); }

HWY_INLINE std::uint32_t bits_of(FMask mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Floats(), mask, bytes);
    return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8;
}

// A wider bundle (cells between its outermost lanes) is walked lane by lane:
// its slices would be full of cells few lanes cross.
constexpr std::int32_t widest_bundle = 16;
// Cells of a slice from which on lanes go alone through it: measured.
constexpr std::size_t crowded = 20;
// Blocks across the widest bundle the setup lets pass: its spread and what it
// leans by in a slice.
constexpr std::size_t most_rows = 24;

struct Bundle {
    bool along_x;   // p is x
    bool forward;   // p grows
    bool sideways;  // q grows, or stays
    // Bounds over all lanes: descent <= descent_base + descent_slope * a,
    // side_low + lean_low * a <= q <= side_high + lean_high * a.
    float descent_base, descent_slope;
    float side_low, lean_low, side_high, lean_high;
    float lowest_start, lowest_end;  // heights
    float a_end;                     // no lane gets further
    std::int32_t rows;               // of blocks that a slice can touch
    std::int32_t block_p, block_q;   // the first block; may lie outside the period
    // Where each lane starts: whole cells from the first block's near wall and
    // least q, and the rest.
    F cells_p, cells_q, inside_p, inside_q;

    // No lane is lower than this before it has come `a` far.
    HWY_INLINE F lowest(F a) const {
        const Floats d;
        return hn::Max(hn::Set(d, lowest_end - skip_margin),
                       hn::NegMulAdd(a, hn::Set(d, descent_slope), hn::Set(d, lowest_start - descent_base - skip_margin)));
    }
    HWY_INLINE F low_q(F near, F far) const {
        const Floats d;
        return hn::MulAdd(lean_low < 0 ? far : near, hn::Set(d, lean_low), hn::Set(d, side_low));
    }
    HWY_INLINE F high_q(F near, F far) const {
        const Floats d;
        return hn::MulAdd(lean_high < 0 ? near : far, hn::Set(d, lean_high), hn::Set(d, side_high));
    }
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
    if (static_cast<std::size_t>(p_size >> block_level) < lane_count) return false;  // a vector of slices would meet itself

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
    out.descent_base = largest(hn::Neg(hn::Mul(a_start, pace))) + 1e-6f;
    out.lean_low = least(lean);
    out.lean_high = largest(lean);
    out.side_low = least(side) - 0.001f;
    out.side_high = largest(side) + 0.001f;
    out.lowest_start = least(z_start);
    out.lowest_end = least(hn::Sub(z_start, descent_end));
    out.a_end = largest(hn::MulAdd(hn::Abs(out.along_x ? speed_x : speed_y), descent_end, a_start));
    const float leans =
        std::max(std::fabs(out.lean_low), std::fabs(out.lean_high)) * block_side + (out.lean_high - out.lean_low) * out.a_end;
    out.rows = static_cast<std::int32_t>((out.side_high - out.side_low + leans) * (1.0f / block_side)) + 2;
    // Beyond 2^14 cells the bounds' rounding outgrows their widening.
    return out.side_high - out.side_low < 3 * widest_bundle && (out.lean_high - out.lean_low) * out.a_end < widest_bundle &&
           out.a_end < 16384.0f && out.rows <= static_cast<std::int32_t>(most_rows);
}

HWY_INLINE std::int32_t in_period(std::int32_t v, std::int32_t size) {
    v %= size;
    return v < 0 ? v + size : v;
}

// Slices as lanes: which rows of blocks each crosses, and which of those the
// bundle does not clear.
struct SliceGroup {
    alignas(64) std::int32_t lowest_row[lane_count];  // relative to the bundle's block_q
    alignas(64) std::int32_t column[lane_count];      // in one period
    std::uint32_t touched[most_rows];                 // by row from the lowest, a bit per slice
    std::int32_t rows;
    std::uint32_t any;
};

HWY_INLINE void test_slices(const CastGrid& grid, const Bundle& bundle, int first, SliceGroup& out) {
    const Floats d;
    const Ints di;
    const int p_blocks = (bundle.along_x ? grid.width : grid.height) >> block_level;
    const int q_blocks = (bundle.along_x ? grid.height : grid.width) >> block_level;
    const F near = hn::ConvertTo(d, hn::ShiftLeft<block_level>(hn::Iota(di, first)));
    const F far = hn::Add(near, hn::Set(d, static_cast<float>(block_side)));
    const F lowest = bundle.lowest(far);
    const I row_low = hn::ShiftRight<block_level>(hn::ConvertTo(di, hn::Floor(bundle.low_q(near, far))));
    const I row_high = hn::ShiftRight<block_level>(hn::ConvertTo(di, hn::Floor(bundle.high_q(near, far))));
    const std::int32_t column = in_period(bundle.block_p + (bundle.forward ? first : -first), p_blocks);
    I p = bundle.forward ? hn::Iota(di, column) : hn::Sub(hn::Set(di, column), hn::Iota(di, 0));
    p = hn::Sub(p, hn::IfThenElseZero(hn::Gt(p, hn::Set(di, p_blocks - 1)), hn::Set(di, p_blocks)));
    p = hn::Add(p, hn::IfThenElseZero(hn::Lt(p, hn::Zero(di)), hn::Set(di, p_blocks)));
    const FMask on_the_way = hn::Lt(near, hn::Set(d, bundle.a_end));
    const I spread = hn::Sub(row_high, row_low);
    out.rows = bundle.rows;
    hn::Store(row_low, di, out.lowest_row);
    hn::Store(p, di, out.column);
    const std::uint16_t* const tops =
        grid.nodes + static_cast<std::size_t>(grid.stack - (grid.stack >> block_level)) * static_cast<std::size_t>(grid.node_pitch);
    const bool power_of_two = (q_blocks & (q_blocks - 1)) == 0;
    out.any = 0;
    for (std::int32_t r = 0; r < out.rows; ++r) {
        I q = hn::Add(row_low, hn::Set(di, bundle.block_q + r));
        if (power_of_two) {
            q = hn::And(q, hn::Set(di, q_blocks - 1));
        } else {
            const F middle = hn::Add(hn::ConvertTo(d, q), hn::Set(d, 0.5f));
            const F periods = hn::Floor(hn::Mul(middle, hn::Set(d, 1.0f / static_cast<float>(q_blocks))));
            q = hn::Sub(q, hn::Mul(hn::ConvertTo(di, periods), hn::Set(di, q_blocks)));
        }
        const I row = bundle.along_x ? q : p, in_row = bundle.along_x ? p : q;
        const F top = node_top(tops, hn::Add(hn::Mul(row, hn::Set(di, grid.node_pitch)), in_row));
        const FMask crossed = hn::RebindMask(d, hn::Gt(hn::Set(di, r), spread));
        out.touched[r] = bits_of(hn::AndNot(crossed, hn::And(on_the_way, hn::Ge(top, lowest))));
        out.any |= out.touched[r];
    }
}

// group: the first slices, tested.
HWY_INLINE LaneHits walk_together(const CastGrid& grid, const Lanes& lanes, const Bundle& bundle, SliceGroup& group) {
    const Floats d;
    const Ints di;
    const F zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const bool along_x = bundle.along_x, forward = bundle.forward;
    const LaneAxis& p = along_x ? lanes.x : lanes.y;
    const LaneAxis& q = along_x ? lanes.y : lanes.x;
    const F speed_p = hn::Load(d, p.speed), speed_q = hn::Load(d, q.speed);
    const F back_p = hn::Neg(hn::Load(d, p.inverse));
    // A lane that does not move sideways has either sign: it takes that of the
    // others.
    const F back_q = hn::CopySign(hn::Load(d, q.inverse), hn::Set(d, bundle.sideways ? -1.0f : 1.0f));
    const F z_start = hn::Load(d, lanes.z_start), descent_end = hn::Load(d, lanes.descent_end);
    const F along = hn::Add(bundle.cells_p, bundle.inside_p), a_start = forward ? along : hn::Neg(along);
    const F pace = hn::Abs(back_p);
    const F speed_pq = hn::Mul(speed_p, speed_q);
    const int p_blocks = (along_x ? grid.width : grid.height) >> block_level;
    const int q_blocks = (along_x ? grid.height : grid.width) >> block_level;
    const std::size_t near_p = forward ? 0 : 1, near_q = bundle.sideways ? 0 : 1;
    const unsigned u_shift = along_x ? 0 : block_level, v_shift = along_x ? block_level : 0;
    const int slope_p = along_x ? patch_slope_x : patch_slope_y, slope_q = along_x ? patch_slope_y : patch_slope_x;

    // Where each lane enters the cell of its hit, and the gap (field minus ray)
    // from there on: gap + s (slope + s bend).
    F hit_begin = descent_end, hit_gap = zero, hit_slope = one, hit_bend = zero;
    FMask found = hn::Lt(zero, zero);

    const int slices = static_cast<int>(bundle.a_end * (1.0f / block_side)) + 1;
    for (int first = 0; first < slices && !hn::AllTrue(d, found); first += static_cast<int>(lane_count)) {
        if (first > 0) test_slices(grid, bundle, first, group);
        for (std::uint32_t any = group.any; any != 0; any &= any - 1) {
            const int slice = std::countr_zero(any);
            const float a_near = static_cast<float>((first + slice) * block_side);
            // Lanes where they cross the near wall of the slice, or start; from here
            // on everything is relative to that.
            const F descent = hn::Min(hn::Max(hn::Mul(hn::Sub(hn::Set(d, a_near), a_start), pace), zero), descent_end);
            const F before = hn::Neg(descent), z_here = hn::Sub(z_start, descent);
            const float low_wall = forward ? a_near : -a_near - block_side;
            const F p_here = precise_offset(speed_p, hn::Load(d, p.rest), descent, hn::Sub(hn::Set(d, low_wall), bundle.cells_p),
                                            bundle.inside_p);
            // The same across, from the near wall of a row of blocks.
            const auto place_q = [&](std::int32_t row) {
                const F wall = hn::Sub(hn::Set(d, static_cast<float>(row * block_side)), bundle.cells_q);
                return precise_offset(speed_q, hn::Load(d, q.rest), descent, wall, bundle.inside_q);
            };
            // The cells that the bundle crosses without clearing them: row of blocks
            // times 16, and place in the block.
            std::int32_t cells[most_rows * block_cells + lane_count];
            const float* patches[most_rows];
            std::size_t count = 0;
            F highest[block_cells / lane_count];
            for (F& h : highest) h = zero;
            for (std::int32_t r = 0; r < group.rows; ++r) {
                if ((group.touched[r] >> slice & 1) == 0) continue;
                const std::int32_t row = group.lowest_row[slice] + r;
                const std::int32_t block_q = in_period(bundle.block_q + row, q_blocks), block_p = group.column[slice];
                const std::size_t block = along_x ? static_cast<std::size_t>(block_q) * static_cast<std::size_t>(p_blocks) +
                                                        static_cast<std::size_t>(block_p)
                                                  : static_cast<std::size_t>(block_p) * static_cast<std::size_t>(q_blocks) +
                                                        static_cast<std::size_t>(block_q);
                patches[r] = grid.patches + block * patch_floats;
                const float q_low = static_cast<float>(row * block_side);
                for (std::size_t c = 0; c < block_cells; c += lane_count) {
                    const I cell = hn::Iota(di, static_cast<std::int32_t>(c));
                    const F minor = hn::ConvertTo(d, hn::And(cell, hn::Set(di, block_side - 1))),
                            major = hn::ConvertTo(d, hn::ShiftRight<block_level>(cell));
                    const F u = along_x ? minor : major, v = along_x ? major : minor;
                    const F near = forward ? hn::Add(u, hn::Set(d, a_near)) : hn::Sub(hn::Set(d, a_near + (block_side - 1)), u);
                    const F far = hn::Add(near, one), here_q = hn::Add(v, hn::Set(d, q_low));
                    const F top = hn::Mul(hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(hn::Rebind<std::uint16_t, Ints>(),
                                                                                       grid.tops + block * block_cells + c))),
                                          hn::Set(d, node_unit));
                    const FMask crossed =
                        hn::And(hn::Ge(hn::Add(here_q, one), bundle.low_q(near, far)), hn::Le(here_q, bundle.high_q(near, far)));
                    const FMask left = hn::And(crossed, hn::Ge(top, bundle.lowest(far)));
                    highest[c / lane_count] = hn::Max(highest[c / lane_count], hn::IfThenElseZero(left, top));
                    count +=
                        hn::CompressStore(hn::Add(cell, hn::Set(di, r * block_cells)), hn::RebindMask(di, left), di, cells + count);
                }
            }
            // A cell behind what a lane hit in an earlier slice is left before it is
            // entered.
            const F after = hn::Sub(hit_begin, descent);
            F nearest = hn::Set(d, never);
            // Puts a patch to all lanes, which cross its cell from enter to exit; x0,
            // y0: their places in the cell at `descent`.
            const auto put = [&](F h00, F b, F c, F twist, F x0, F y0, F enter, F exit) {
                const F length = hn::Sub(exit, enter);
                const F x = hn::MulAdd(speed_p, enter, x0), y = hn::MulAdd(speed_q, enter, y0);
                const F leans = hn::MulAdd(twist, x, c);
                const F gap = hn::MulAdd(leans, y, hn::MulAdd(b, x, hn::Add(enter, hn::Sub(h00, z_here))));
                const F slope = hn::MulAdd(hn::MulAdd(twist, y, b), speed_p, hn::MulAdd(leans, speed_q, one));
                const F bend = hn::Mul(twist, speed_pq);
                const F last = hn::MulAdd(length, hn::MulAdd(length, bend, slope), gap);
                // Below at the entry or at the exit of a cell that is crossed.
                FMask hit = hn::Ge(hn::Min(length, hn::Max(gap, last)), zero);
                // Above at both, yet below between: a gap that rises and falls, with
                // real roots.
                const F last_slope = hn::MulAdd(hn::Add(bend, bend), length, slope);
                const FMask dome = hn::Gt(hn::Min(length, hn::Min(slope, hn::Neg(last_slope))), zero);
                if (HWY_UNLIKELY(!hn::AllFalse(d, dome)))
                    hit = hn::Or(hit, hn::And(dome, hn::Ge(hn::Mul(slope, slope), hn::Mul(hn::Mul(hn::Set(d, 4.0f), bend), gap))));
                // Of cells hit the nearest, whatever their order. Compared last, so
                // that cells do not wait for each other.
                hit = hn::And(hit, hn::Lt(enter, nearest));
                nearest = hn::IfThenElse(hit, enter, nearest);
                hit_gap = hn::IfThenElse(hit, gap, hit_gap);
                hit_slope = hn::IfThenElse(hit, slope, hit_slope);
                hit_bend = hn::IfThenElse(hit, bend, hit_bend);
            };
            if (count > crowded && q_blocks >= static_cast<int>(most_rows)) {
                // Too many cells to put each to all lanes: every lane goes through its
                // own, from where it is down to the highest.
                alignas(64) float tops[block_cells];
                for (std::size_t c = 0; c < block_cells; c += lane_count) hn::Store(highest[c / lane_count], d, tops + c);
                F begin = hn::Set(d, never);
                for (unsigned w = 0; w < block_side; ++w) {
                    // In this column a lane is clear until it is down to the column's highest.
                    const float* const top = tops + (w << u_shift);
                    const std::size_t next = std::size_t{1} << v_shift;
                    const float column_top = std::max(std::max(top[0], top[next]), std::max(top[2 * next], top[3 * next]));
                    const F in = hn::Mul(hn::Sub(p_here, hn::Set(d, static_cast<float>(w + near_p))), back_p);
                    const F out = hn::Mul(hn::Sub(p_here, hn::Set(d, static_cast<float>(w + 1 - near_p))), back_p);
                    const F down = hn::Max(hn::Max(hn::Sub(z_here, hn::Set(d, column_top + skip_margin)), in), zero);
                    begin = hn::Min(begin, hn::IfThenElse(hn::Le(down, out), down, hn::Set(d, never)));
                }
                // Lanes that clear every column stay where they are, and out.
                FMask alive = hn::Lt(begin, hn::Min(after, hn::Set(d, never)));
                begin = hn::IfThenElseZero(alive, begin);
                const std::int32_t lowest_row = group.lowest_row[slice];
                const F q_here = place_q(lowest_row);
                const F last_u = hn::Set(d, block_side - 1.0f),
                        last_v = hn::Set(d, static_cast<float>(group.rows * block_side - 1));
                F u = hn::Min(hn::Max(hn::Floor(hn::MulAdd(speed_p, begin, p_here)), zero), last_u);
                F v = hn::Min(hn::Max(hn::Floor(hn::MulAdd(speed_q, begin, q_here)), zero), last_v);
                const F step_u = hn::Set(d, forward ? 1.0f : -1.0f), step_v = hn::Set(d, bundle.sideways ? 1.0f : -1.0f);
                const F near_u = hn::Set(d, static_cast<float>(near_p)), near_v = hn::Set(d, static_cast<float>(near_q));
                const I first_block = hn::Set(di, in_period(bundle.block_q + lowest_row, q_blocks)), period = hn::Set(di, q_blocks);
                const I row_floats = hn::Set(di, along_x ? p_blocks * patch_floats : patch_floats);
                const float* const column = grid.patches + static_cast<std::size_t>(group.column[slice]) *
                                                               static_cast<std::size_t>(along_x ? 1 : q_blocks) * patch_floats;
                for (;;) {
                    const I cell_u = hn::ConvertTo(di, u), cell_v = hn::ConvertTo(di, v);
                    I block = hn::Add(first_block, hn::ShiftRight<block_level>(cell_v));
                    block = hn::Sub(block, period);
                    block = hn::Add(block, hn::IfThenElseZero(hn::Lt(block, hn::Zero(di)), period));
                    const I in_v = hn::And(cell_v, hn::Set(di, block_side - 1));
                    const I cell = along_x ? hn::Add(hn::ShiftLeft<block_level>(in_v), cell_u)
                                           : hn::Add(hn::ShiftLeft<block_level>(cell_u), in_v);
                    const I at = hn::Add(hn::Mul(block, row_floats), cell);
                    const F h00 = hn::GatherIndex(d, column + patch_height, at), b = hn::GatherIndex(d, column + slope_p, at);
                    const F c = hn::GatherIndex(d, column + slope_q, at), twist = hn::GatherIndex(d, column + patch_twist, at);
                    const F x0 = hn::Sub(p_here, u), y0 = hn::Sub(q_here, v);
                    const F far_p = hn::Mul(hn::Sub(x0, hn::Sub(one, near_u)), back_p),
                            far_q = hn::Mul(hn::Sub(y0, hn::Sub(one, near_v)), back_q);
                    const F enter =
                        hn::Max(hn::Max(hn::Mul(hn::Sub(x0, near_u), back_p), hn::Mul(hn::Sub(y0, near_v), back_q)), begin);
                    put(h00, b, c, twist, x0, y0, enter, hn::Min(hn::Min(far_p, far_q), after));
                    const FMask through_p = hn::Le(far_p, far_q);
                    u = hn::Add(u, hn::IfThenElseZero(through_p, step_u));
                    v = hn::Add(v, hn::IfThenElse(through_p, zero, step_v));
                    const F inside_u = hn::Min(hn::Max(u, zero), last_u), inside_v = hn::Min(hn::Max(v, zero), last_v);
                    alive = hn::And(hn::And(alive, hn::Eq(nearest, hn::Set(d, never))),
                                    hn::And(hn::Eq(u, inside_u), hn::Eq(v, inside_v)));
                    if (hn::AllFalse(d, alive)) break;
                    u = inside_u, v = inside_v;
                }
            } else {
                // Walls of cells as descents from here, and places relative to cells: four columns, and the same for each row of
                // blocks.
                alignas(64) float walls_p[block_side + 1][lane_count], places_p[block_side][lane_count];
                alignas(64) float walls_q[most_rows * (block_side + 1)][lane_count], places_q[most_rows * block_side][lane_count];
                for (int w = 0; w <= block_side; ++w) {
                    const F x = hn::Sub(p_here, hn::Set(d, static_cast<float>(w)));
                    hn::Store(hn::Mul(x, back_p), d, walls_p[w]);
                    if (w < block_side) hn::Store(x, d, places_p[w]);
                }
                for (std::int32_t r = 0; r < group.rows; ++r) {
                    if ((group.touched[r] >> slice & 1) == 0) continue;
                    const F q_here = place_q(group.lowest_row[slice] + r);
                    for (int w = 0; w <= block_side; ++w) {
                        const F y = hn::Sub(q_here, hn::Set(d, static_cast<float>(w)));
                        hn::Store(hn::Mul(y, back_q), d, walls_q[r * (block_side + 1) + w]);
                        if (w < block_side) hn::Store(y, d, places_q[r * block_side + w]);
                    }
                }
                for (std::size_t k = 0; k < count; ++k) {
                    const auto entry = static_cast<unsigned>(cells[k]);
                    const unsigned r = entry / block_cells, cell = entry % block_cells;
                    const unsigned u = cell >> u_shift & (block_side - 1), v = cell >> v_shift & (block_side - 1);
                    const float* const patch = patches[r] + cell;
                    const std::size_t wall_q = r * (block_side + 1) + v;
                    const F enter =
                        hn::Max(hn::Max(hn::Load(d, walls_p[u + near_p]), hn::Load(d, walls_q[wall_q + near_q])), before);
                    const F exit =
                        hn::Min(hn::Min(hn::Load(d, walls_p[u + 1 - near_p]), hn::Load(d, walls_q[wall_q + 1 - near_q])), after);
                    put(hn::Set(d, patch[patch_height]), hn::Set(d, patch[slope_p]), hn::Set(d, patch[slope_q]),
                        hn::Set(d, patch[patch_twist]), hn::Load(d, places_p[u]), hn::Load(d, places_q[r * block_side + v]), enter,
                        exit);
                }
            }
            const FMask hit_here = hn::Lt(nearest, hn::Set(d, never));
            hit_begin = hn::IfThenElse(hit_here, hn::Add(descent, nearest), hit_begin);
            found = hn::Or(found, hit_here);
            if (hn::AllTrue(d, found)) break;
        }
    }
    return {hit_begin, hit_gap, hit_slope, hit_bend, found};
}

}  // namespace HWY_NAMESPACE
}  // namespace relievo
HWY_AFTER_NAMESPACE();

#endif  // per target
