// What a bundle may touch on its way: slices (columns of 4x4 blocks across the way), and in a slice its blocks.
#if defined(RELIEVO_CAST_SLICES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELIEVO_CAST_SLICES_H
#undef RELIEVO_CAST_SLICES_H
#else
#define RELIEVO_CAST_SLICES_H
#endif

#include "cast/bundle.h"

HWY_BEFORE_NAMESPACE();
namespace relievo {
namespace HWY_NAMESPACE {

// Slices of few cells are taken together until they have more blocks than this. Anything from 8 to 20 is as good.
constexpr std::size_t few_blocks = 10;
// A bundle that comes down, on the way through a slice, by this many times what the roof of its blocks lies above the mean of their
// cells soon meets the surface below the roof: no bound of single cells is worth its test. Measured; 0.7 to 2 are as good.
constexpr float steepness = 1;

HWY_INLINE std::int32_t in_period(std::int32_t v, std::int32_t size) {
    if ((size & (size - 1)) == 0) return v & (size - 1);
    v %= size;
    return v < 0 ? v + size : v;
}

// v in one period, for whole numbers far below 2^23.
HWY_INLINE I wrapped(I v, std::int32_t size) {
    const Floats d;
    const Ints di;
    if ((size & (size - 1)) == 0) return hn::And(v, hn::Set(di, size - 1));
    const F middle = hn::Add(hn::ConvertTo(d, v), hn::Set(d, 0.5f));
    const F periods = hn::Floor(hn::Mul(middle, hn::Set(d, 1.0f / static_cast<float>(size))));
    return hn::Sub(v, hn::Mul(whole(periods), hn::Set(di, size)));
}

HWY_INLINE std::uint32_t bits_of(FMask mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Floats(), mask, bytes);
    return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8;
}

// A vector of slices.
struct SliceGroup {
    alignas(64) std::int32_t lowest_row[lane_count];  // of blocks that the bundle crosses there, relative to its block_q
    alignas(64) std::int32_t highest_row[lane_count];
    alignas(64) std::int32_t column[lane_count];  // in one period
    alignas(64) float roof[lane_count];           // nothing that the bundle crosses there is higher
    std::uint32_t touched;                        // a bit per slice: the bundle may not clear it
    std::uint32_t smooth;                         // a bit per slice: see steepness
};

// Slices from `first` on. One gather for each roof_blocks rows.
HWY_INLINE void test_slices(const CastGrid& grid, const Bundle& bundle, std::int32_t first, SliceGroup& out) {
    const Floats d;
    const Ints di;
    const I step = hn::Add(hn::Iota(di, 0), hn::Set(di, first)), start = hn::Set(di, bundle.block_p);
    const F near = hn::ConvertTo(d, hn::ShiftLeft<block_level>(step));
    const F lowest = hn::Max(hn::Set(d, bundle.floor), hn::NegMulAdd(near, hn::Set(d, bundle.descent_slope),
                                                                     hn::Set(d, bundle.roof - block_side * bundle.descent_slope)));
    const F low_q =
        hn::MulAdd(near, hn::Set(d, bundle.lean_low), hn::Set(d, bundle.side_low + block_side * std::min(bundle.lean_low, 0.0f)));
    const F high_q = hn::MulAdd(near, hn::Set(d, bundle.lean_high),
                                hn::Set(d, bundle.side_high + block_side * std::max(bundle.lean_high, 0.0f)));
    const I row_low = hn::ShiftRight<block_level>(whole(hn::Floor(low_q)));
    const I row_high = hn::ShiftRight<block_level>(whole(hn::Floor(high_q)));
    const I p = wrapped(hn::Add(start, hn::Mul(step, hn::Set(di, bundle.forward ? 1 : -1))), bundle.p_blocks);
    hn::Store(row_low, di, out.lowest_row);
    hn::Store(row_high, di, out.highest_row);
    hn::Store(p, di, out.column);
    const auto* const roofs = reinterpret_cast<const std::int32_t*>(bundle.along_x ? grid.roofs_up : grid.roofs_right);
    const I begin = hn::Add(row_low, hn::Set(di, bundle.block_q));
    const I p_pitch = hn::Set(di, bundle.along_x ? bundle.p_blocks : 1),
            q_pitch = hn::Set(di, bundle.along_x ? 1 : bundle.q_blocks);
    I top_bits = hn::Zero(di), hollow_bits = hn::Zero(di);
    for (std::int32_t r = 0; r < bundle.rows; r += roof_blocks) {
        const I q = wrapped(hn::Add(begin, hn::Set(di, r)), bundle.q_blocks);
        const I block = hn::Add(hn::Mul(q, p_pitch), hn::Mul(p, q_pitch));
        const I roof = hn::GatherIndex(di, roofs, block);
        const I here = hn::BitCast(di, hn::ShiftRight<16>(hn::BitCast(hn::RebindToUnsigned<Ints>(), roof)));
        top_bits = hn::Max(top_bits, here);
        hollow_bits = hn::Max(hollow_bits, hn::Sub(here, hn::And(roof, hn::Set(di, 0xffff))));
    }
    const F top = hn::Mul(hn::ConvertTo(d, top_bits), hn::Set(d, node_unit));
    out.smooth = bits_of(hn::Le(hn::Mul(hn::ConvertTo(d, hollow_bits), hn::Set(d, node_unit)),
                                hn::Set(d, bundle.descent_slope * (steepness * block_side))));
    hn::Store(top, d, out.roof);
    out.touched = bits_of(hn::And(hn::Ge(top, lowest), hn::Lt(near, hn::Set(d, bundle.a_end))));
}

static_assert(tops_slack >= most_rows + lane_count);
constexpr std::size_t most_blocks = most_rows + few_blocks + lane_count;
// Blocks that the bundle crosses without clearing them.
struct BlockList {
    std::int32_t block[most_blocks];  // index in the grid
    std::int32_t patch[most_blocks];  // of its first cell
    float q_low[most_blocks];         // relative to the bundle's block_q
    float a_near[most_blocks];        // of the slice
};

// Appends those of a slice, which begins at a_near, to the `count` there are; the new count.
HWY_INLINE std::size_t find_blocks(const CastGrid& grid, const Bundle& bundle, const SliceGroup& group, std::size_t slice,
                                   float a_near, BlockList& out, std::size_t count) {
    const Floats d;
    const Ints di;
    const F lowest = hn::Set(d, std::max(bundle.floor, bundle.roof - bundle.descent_slope * (a_near + block_side)));
    const std::int32_t crossed = group.highest_row[slice] - group.lowest_row[slice];
    const std::int32_t q_first = in_period(bundle.block_q + group.lowest_row[slice], bundle.q_blocks);
    const std::int32_t p_pitch = bundle.along_x ? 1 : bundle.q_blocks, q_pitch = bundle.along_x ? bundle.p_blocks : 1;
    const std::int32_t p_floats = block_side * (bundle.along_x ? patch_step : grid.patch_pitch),
                       q_floats = block_side * (bundle.along_x ? grid.patch_pitch : patch_step);
    const std::int32_t column = group.column[slice];
    const float* const tops = (bundle.along_x ? grid.tops_up : grid.tops_right) +
                              static_cast<std::size_t>(column) * static_cast<std::size_t>(bundle.q_blocks + tops_slack) + q_first;
    for (std::int32_t r = 0; r < bundle.rows; r += static_cast<std::int32_t>(lane_count)) {
        const I row = hn::Add(hn::Iota(di, 0), hn::Set(di, r));
        const I q = wrapped(hn::Add(row, hn::Set(di, q_first)), bundle.q_blocks);
        const I block = hn::Add(hn::Mul(q, hn::Set(di, q_pitch)), hn::Set(di, column * p_pitch));
        const F top = hn::LoadU(d, tops + r);
        const IMask left = hn::AndNot(hn::Gt(row, hn::Set(di, crossed)), hn::RebindMask(di, hn::Ge(top, lowest)));
        const F q_low = hn::ConvertTo(d, hn::ShiftLeft<block_level>(hn::Add(row, hn::Set(di, group.lowest_row[slice]))));
        hn::StoreU(hn::Set(d, a_near), d, out.a_near + count);
        hn::StoreU(hn::Compress(block, left), di, out.block + count);
        const I patch = hn::Add(hn::Mul(q, hn::Set(di, q_floats)), hn::Set(di, column * p_floats));
        hn::StoreU(hn::Compress(patch, left), di, out.patch + count);
        hn::StoreU(hn::Compress(q_low, hn::RebindMask(d, left)), d, out.q_low + count);
        count += hn::CountTrue(di, left);
    }
    return count;
}

}  // namespace HWY_NAMESPACE
}  // namespace relievo
HWY_AFTER_NAMESPACE();

#endif  // per target
